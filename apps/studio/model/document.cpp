// SPDX-License-Identifier: Apache-2.0
#include "document.h"

#include "session_text.h"

#include <asperity/formats/atomic_file.h>
#include <asperity/formats/read_file.h>

#include <QFile>

#include <chrono>
#include <utility>

namespace asperity::studio {
namespace {

using Clock = std::chrono::steady_clock;

/// Steps of one name that follow each other faster than this are one movement of the hand.
constexpr auto kOneMovement = std::chrono::seconds(1);
constexpr int kMostSteps = 1000;
constexpr std::uint64_t kLongestSession = 1 << 20;

std::string file_name(const QString& path) {
    return QFile::encodeName(path).toStdString();
}

}  // namespace

/// A change from one state of all settings to another.
class Document::Step : public QUndoCommand {
  public:
    Step(Document& document, const QString& what, State after)
        : QUndoCommand(what),
          document_(document),
          before_(document.state_),
          after_(std::move(after)) {}

    void undo() override { document_.state_ = before_; }
    void redo() override { document_.state_ = after_; }

    int id() const override { return 1; }  // steps of this kind may be merged
    bool mergeWith(const QUndoCommand* other) override {
        const auto* next = dynamic_cast<const Step*>(other);
        if (next == nullptr || next->text() != text() || next->when_ - when_ > kOneMovement)
            return false;
        after_ = next->after_;
        when_ = next->when_;
        setObsolete(before_.text == after_.text);
        return true;
    }

  private:
    Document& document_;
    State before_, after_;
    Clock::time_point when_ = Clock::now();
};

Document::State::State(StudioSettings all)
    : settings(std::move(all)), text(session_text(settings)) {}

Document::Document(QObject* parent) : QObject(parent) {
    undo_.setUndoLimit(kMostSteps);
    // Steps change the settings silently; it is told when the history is in order again, so that a
    // listener may make another change
    connect(&undo_, &QUndoStack::indexChanged, this, &Document::announce);
}

void Document::change(const QString& what, const std::function<void(StudioSettings&)>& edit) {
    StudioSettings edited = settings();
    edit(edited);
    State after(std::move(edited));
    if (after.text == state_.text) return;
    undo_.push(new Step(*this, what, std::move(after)));
}

void Document::reset(const StudioSettings& settings) {
    replace(settings, {});
}

void Document::restore(const StudioSettings& settings, const QString& path) {
    replace(settings, path);
    undo_.resetClean();
}

void Document::replace(const StudioSettings& settings, const QString& path) {
    state_ = State(settings);
    undo_.clear();
    set_path(path);
    announce();
}

void Document::open(const QString& path) {
    const std::string name = file_name(path);
    replace(session_from_text(io::read_text_file(name, kLongestSession), name), path);
}

void Document::save(const QString& path) {
    StudioSettings saved = settings();
    for (const auto& look : looks_) look(saved);
    io::AtomicFile file(file_name(path));
    file.write(session_text(saved));
    file.commit();
    undo_.setClean();
    set_path(path);
}

void Document::announce() {
    const State before = std::exchange(told_, state_);
    if (before.text != state_.text) emit changed(before.settings);
}

void Document::set_path(const QString& path) {
    if (path == path_) return;
    path_ = path;
    emit path_changed();
}

}  // namespace asperity::studio
