// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "bindings.h"
#include "section.h"

#include <asperity/params/param.h>

#include <functional>

namespace asperity::studio {

/// "Surface Settings": which kind of surface, its size, and the fields of the chosen kind.
class SurfaceFields : public Section {
    Q_OBJECT

  public:
    explicit SurfaceFields(Workbench& workbench, QWidget* parent = nullptr);

    /// Asks for a file and makes its heights the surface.
    void open_file();

  private:
    using Shown = std::function<bool(const StudioSettings&)>;
    void add_kind();
    /// The row of a setting of surfaces, there when the chosen kind uses it.
    void add_setting(const Param<StudioSettings>& param);
    void add_alphas(const Param<StudioSettings>& param, const Shown& used);
    void add_correlation_length(const Param<StudioSettings>& param, const Shown& used);
    void add_period(const Param<StudioSettings>& param, const Shown& used);
    void add_direction(const Param<StudioSettings>& param, const Shown& used);
    void add_file();
    void add_file_note(const Shown& is_file);
    void add_size();
    /// A row that is there for some kinds only. Locked while a drawing runs.
    void add_row(const QString& label, QWidget* control, const QString& tooltip, Shown shown);
    void show_rows();
    void apply_size();

    Workbench& workbench_;
    Bindings bindings_;
    DrawingLock lock_;
    struct Row {
        QWidget* control;
        Shown shown;
    };
    std::vector<Row> rows_;
    QSpinBox* size_ = nullptr;
    int size_shown_ = 0;  ///< as it was set last from the settings
};

}  // namespace asperity::studio
