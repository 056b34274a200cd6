// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "document.h"
#include "drawing.h"
#include "light_seen.h"
#include "surface_source.h"

#include <QObject>
#include <QStringList>

#include <optional>

namespace asperity::studio {

/// All that the windows work on, and how the parts follow each other. Knows no widgets.
///
/// Surface settings changed: the surface is made anew. Surface, Current Layer or the shown cell
/// changed: the paths are looked for anew, if they are shown. Layers that no longer belong to the
/// settings stay until they are cleared or drawn anew, and are_layers_current() says so.
class Workbench : public QObject {
    Q_OBJECT

  public:
    explicit Workbench(QObject* parent = nullptr);

    Document& document() { return document_; }
    SurfaceSource& surface() { return surface_; }
    Drawing& drawing() { return drawing_; }
    LightSeen& light() { return light_; }
    const StudioSettings& settings() const { return document_.settings(); }

    /// Draw To Textures with the settings as they are; waits for a surface under way. Errors come
    /// as `complaint`.
    void draw_to_textures();
    /// Stop Drawing, also of a drawing that still waits for its surface.
    void stop_drawing();
    bool are_layers_current() const;
    /// Where the light of the layers comes from: as the settings say, or as the lobe of the surface
    /// that is there asks.
    IlluminationSettings incident_light() const;
    /// True while a drawing runs or waits: settings that decide it must not change.
    bool is_drawing() const;

    /// The cell of the detector that is looked at in dome and plots; none: no cell.
    void select_cell(std::optional<int> cell);
    std::optional<int> selected_cell() const { return cell_; }

    /// The thesis' "Print to log": lines that the log window shows.
    void log(const QString& line);
    const QStringList& log_lines() const { return log_; }

  signals:
    void cell_selected();
    void drawing_changed();                   ///< is_drawing() may have
    void complaint(const QString& sentence);  ///< an error, as the CLI prints it
    void logged(const QString& line);

  private:
    void follow_settings(const StudioSettings& before);
    void look_for_paths();
    void surface_ready();
    void begin_drawing();
    void set_waiting(bool waiting);
    void complain(const QString& sentence);

    Document document_;
    SurfaceSource surface_;
    Drawing drawing_;
    LightSeen light_;
    std::optional<int> cell_;
    bool draw_when_ready_ = false;
    QStringList log_;
};

}  // namespace asperity::studio
