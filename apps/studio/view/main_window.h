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

  protected:
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
    bool closing_ = false;
};

}  // namespace asperity::studio
