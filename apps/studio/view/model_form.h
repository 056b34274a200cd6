// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "../model/model_settings.h"
#include "bindings.h"

#include <QWidget>

#include <algorithm>

namespace asperity::studio {

/// A field for each parameter of an analytic model, made from its rows.
class ModelForm : public QWidget {
    Q_OBJECT

  public:
    /// `prefix` comes before the names of all controls; `side` behind those of the steps.
    ModelForm(Document& document, const ParamTable<StudioSettings>& rows, const QString& prefix,
              const QString& side, QWidget* parent = nullptr);

  private:
    Bindings bindings_;
};

/// The rows of a model whose settings are what access(settings) refers to; those named in `without`
/// are left out.
template <typename Access>
ParamTable<StudioSettings> model_rows(Access access, const BsdfModel& model,
                                      const SpecSettings& without = {}) {
    ParamTable<StudioSettings> rows;
    for (const BsdfParam& param : model.params) {
        const auto is_this = [&](const auto& setting) { return setting.first == param.info.name; };
        if (std::none_of(without.begin(), without.end(), is_this))
            rows.push_back(model_row(access, model, param));
    }
    return rows;
}

}  // namespace asperity::studio
