// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "settings.h"

#include <QObject>
#include <QString>
#include <QUndoStack>

#include <functional>
#include <string>
#include <vector>

namespace asperity::studio {

/// The settings and their history: the one place where a setting changes.
///
/// Lives in the main thread. Widgets show settings() and ask for changes by change(); they follow
/// `changed`, so that undo, the tour and a loaded session move them too.
class Document : public QObject {
    Q_OBJECT

  public:
    explicit Document(QObject* parent = nullptr);

    const StudioSettings& settings() const { return state_.settings; }

    /// Changes settings in a step that can be undone. `what` is its name in the menu, e.g. "Surface
    /// Roughness"; steps with the same name in quick succession (a dragged slider) become one. An
    /// edit that changes nothing is no step.
    void change(const QString& what, const std::function<void(StudioSettings&)>& edit);

    /// Replaces everything, without history: a session was opened or a new one begun.
    void reset(const StudioSettings& settings);
    /// The same for a session that was lost unsaved; `path` as it was, `modified` it is.
    void restore(const StudioSettings& settings, const QString& path);

    /// `look` puts in what only the windows know, such as where cameras stand, before a session is
    /// saved.
    void before_saving(std::function<void(StudioSettings&)> look) {
        looks_.push_back(std::move(look));
    }

    QUndoStack& undo_stack() { return undo_; }

    // Sessions. Throw Error(InvalidInput | InputOutput) and leave all as it was.
    void open(const QString& path);
    void save(const QString& path);
    const QString& path() const { return path_; }  ///< empty: never saved
    bool modified() const { return !undo_.isClean(); }

  signals:
    /// After every change, also those of undo and redo.
    void changed(const asperity::studio::StudioSettings& before);
    void path_changed();

  private:
    class Step;
    /// All settings and the text of their session: everything that a session keeps is in its text,
    /// so that decides what is equal. It is kept as it takes long to make.
    struct State {
        explicit State(StudioSettings all = {});
        StudioSettings settings;
        std::string text;
    };

    void replace(const StudioSettings& settings, const QString& path);
    void announce();
    void set_path(const QString& path);

    State state_;
    State told_ = state_;  ///< as the listeners of `changed` know them
    std::vector<std::function<void(StudioSettings&)>> looks_;
    QUndoStack undo_;
    QString path_;
};

}  // namespace asperity::studio
