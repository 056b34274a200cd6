// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "bindings.h"
#include "section.h"

namespace asperity::studio {

/// How the picture of the model is made and shown: exposure, tone mapping, reflections.
class LookFields : public Section {
    Q_OBJECT

  public:
    explicit LookFields(Document& document, QWidget* parent = nullptr);

  private:
    void add_exposure();
    void add_tone_mapping();
    void add_depth();

    Bindings bindings_;
};

/// Which model is looked at: the built-in ones and the file loaded last; its floor.
class ModelFields : public Section {
    Q_OBJECT

  public:
    explicit ModelFields(Document& document, QWidget* parent = nullptr);

  private:
    void add_models();

    Document& document_;
    Bindings bindings_;
};

}  // namespace asperity::studio
