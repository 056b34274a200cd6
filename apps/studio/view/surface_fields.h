// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "bindings.h"
#include "section.h"

namespace asperity::studio {

/// "Surface Settings": which kind of surface, its size, and the fields of the chosen kind.
class SurfaceFields : public Section {
    Q_OBJECT

  public:
    explicit SurfaceFields(Workbench& workbench, QWidget* parent = nullptr);

    /// Asks for a file and makes its heights the surface.
    void open_file();

  private:
    using Shown = bool (*)(const SurfaceSettings&);
    void add_kind();
    void add_size();
    void add_thesis_fields();
    void add_random_fields();
    void add_shape_fields();
    void add_file_fields();
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
