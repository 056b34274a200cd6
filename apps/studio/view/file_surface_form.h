// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "bindings.h"
#include "section.h"
#include "setting_line.h"

#include <asperity/params/param.h>

#include <QWidget>

#include <map>
#include <string>

namespace asperity::studio {

/// Everything that decides what is read from a surface file and how it is made ready, in the order
/// in which it is done: the rows of surfaces of files. Locked while a drawing runs.
class FileSurfaceForm : public QWidget {
    Q_OBJECT

  public:
    explicit FileSurfaceForm(Workbench& workbench, QWidget* parent = nullptr);

    /// Marks the field of a setting, "filter-s", and no other; empty: none.
    void mark(const std::string& setting, const QString& why);

  signals:
    void refused(const QString& sentence);  ///< what was typed is no value; empty: no longer

  private:
    QWidget* file_section();
    QWidget* steps_section();
    QWidget* plane_section();
    void add(Section& section, const char* setting, QWidget* control);
    void add_row(Section& section, const char* setting);
    SettingLine* new_line(const char* setting, SettingLine::Translate to_row = {},
                          SettingLine::Translate from_row = {});
    SettingLine* cell_size_line();
    QWidget* format_list();
    QWidget* decimal_list();

    Workbench& workbench_;
    Bindings bindings_;
    DrawingLock lock_;
    std::map<std::string, QWidget*> fields_;
};

/// Makes a file the surface: what was said of the file before, its format, channel, decimal mark
/// and cell size, is forgotten; what is done to surfaces stays.
void take_surface_file(Document& document, const QString& path);

}  // namespace asperity::studio
