// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "bindings.h"

#include <QComboBox>

namespace asperity::studio {

/// What the surface file holds, to choose one of it. Its first entry leaves the choice to the file.
class ChannelList : public QComboBox {
    Q_OBJECT

  public:
    explicit ChannelList(Workbench& workbench, QWidget* parent = nullptr);

  private:
    void show_channels();

    Workbench& workbench_;
    Bindings bindings_;
};

}  // namespace asperity::studio
