// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "../model/workbench.h"

#include <QMainWindow>

#include <functional>

namespace asperity::studio {

class ModelScene;
class PlotsPanel;
class SurfacePanel;
class SurfaceScene;
class Tour;

/// The window of the studio: both scenes, their panels, menus, plots and log.
class MainWindow : public QMainWindow {
    Q_OBJECT

  public:
    /// Whether the user is asked before a session that was changed is given up.
    enum class Asking { Yes, No };

    explicit MainWindow(QWidget* parent = nullptr);
    ~MainWindow() override;

    Workbench& workbench();
    SurfaceScene& surface_scene();
    ModelScene& model_scene();
    PlotsPanel& plots();
    SurfacePanel& surface_panel();
    Tour& tour();

    void set_asking(Asking asking) { asking_ = asking; }

    /// A new session as the program begins with one; nothing is asked. `measure`: draws it at once,
    /// and every New Session from then on.
    void begin(bool measure);
    void new_session();
    bool measures_at_start() const { return measure_; }
    void set_measures_at_start(bool measure) { measure_ = measure; }

    /// Opens whatever a file is: a session, a result, a model, a surface. Errors are complained of.
    void open(const QString& path);
    void load_model(const QString& name_or_file);
    void ask_for_model();
    void view(SceneKind scene);
    void run_test();
    /// Sessions that a killed studio left behind: asks whether to restore the latest.
    void offer_lost_session();

    /// Does `then` once the session is saved, or need not be; not at all if the user changes his
    /// mind.
    void after_saving(const std::function<void()>& then);
    void save_session(const std::function<void()>& then = {});
    void save_session_as(const std::function<void()>& then = {});
    void complain(const QString& sentence);
    /// The same, for what the user has just asked for in a dialog: says so in a window of its own.
    void complain_aloud(const QString& sentence);
    /// Docks where they were at the beginning.
    void reset_layout();
    /// For a lecture: the scene alone, in large type, on the full screen. Esc ends it.
    void set_presenting(bool presenting);
    bool is_presenting() const { return presenting_; }

  signals:
    void presenting_changed(bool presenting);

  protected:
    void keyPressEvent(QKeyEvent* event) override;
    void closeEvent(QCloseEvent* event) override;
    void dragEnterEvent(QDragEnterEvent* event) override;
    void dropEvent(QDropEvent* event) override;
    bool eventFilter(QObject* watched, QEvent* event) override;

  private:
    struct Parts;
    void make_docks();
    void follow_settings();
    void show_title();
    bool save_to(const QString& path);

    std::unique_ptr<Parts> parts_;
    Asking asking_ = Asking::Yes;
    bool measure_ = false;
    bool presenting_ = false;
    bool closing_ = false;
};

}  // namespace asperity::studio
