// SPDX-License-Identifier: Apache-2.0
#include "recovery.h"

#include "session_text.h"

#include <asperity/core/error.h>
#include <asperity/formats/atomic_file.h>
#include <asperity/formats/read_file.h>
#include <asperity/gonio/experiment_text.h>

#include <QCoreApplication>
#include <QDir>
#include <QFile>
#include <QFileInfo>
#include <QStandardPaths>
#include <QUuid>

#include <algorithm>
#include <optional>
#include <utility>

namespace asperity::studio {
namespace {

constexpr int kDelay = 3000;  // milliseconds
constexpr std::uint64_t kLongestCopy = 1 << 20;
constexpr const char* kRecoverySection = "recovery";

std::string file_name(const QString& path) {
    return QFile::encodeName(path).toStdString();
}

/// Held by the process a copy belongs to, as long as it lives.
std::unique_ptr<QLockFile> lock_of(const QString& copy) {
    auto lock = std::make_unique<QLockFile>(copy + ".lock");
    lock->setStaleLockTime(0);  // however old, as long as its process lives
    return lock;
}

/// A session, and a section of our own for where it was saved.
std::string copy_text(const Document& document) {
    return session_text(document.settings()) + "\n[" + kRecoverySection + "]\n" +
           setting_line("path", document.path().toStdString());
}

std::optional<Recovery::Lost> read_copy(const QFileInfo& file) {
    const std::string name = file_name(file.filePath());
    try {
        const std::string text = io::read_text_file(name, kLongestCopy);
        Recovery::Lost lost{
            session_from_text(text, name), {}, file.lastModified(), file.filePath()};
        for (const Setting& setting : parse_settings(text, name))
            if (setting.section == kRecoverySection && setting.key == "path")
                lost.path = QString::fromStdString(setting.value);
        return lost;
    } catch (const Error&) {
        return std::nullopt;
    }
}

}  // namespace

Recovery::Recovery(Document& document, const QString& folder, QObject* parent)
    : QObject(parent), document_(document), folder_(folder) {
    QDir().mkpath(folder_);
    copy_ = QStringLiteral("%1/session-%2-%3.txt")
                .arg(folder_)
                .arg(QCoreApplication::applicationPid())
                .arg(QUuid::createUuid().toString(QUuid::Id128).left(8));
    lock_ = lock_of(copy_);
    lock_->tryLock(0);

    timer_.setSingleShot(true);
    timer_.setInterval(kDelay);
    connect(&timer_, &QTimer::timeout, this, &Recovery::keep);
    // Not begun anew by every change: who never pauses is kept, too
    const auto soon = [this] {
        if (!timer_.isActive()) timer_.start();
    };
    connect(&document, &Document::changed, this, soon);
    connect(&document.undo_stack(), &QUndoStack::cleanChanged, this, soon);
}

Recovery::~Recovery() {
    QFile::remove(copy_);
}

std::vector<Recovery::Lost> Recovery::recoverable() const {
    std::vector<Lost> all;
    const QDir folder(folder_);
    for (const QFileInfo& file : folder.entryInfoList({"session-*.txt"}, QDir::Files)) {
        if (!lock_of(file.filePath())->tryLock(0)) continue;  // its process lives
        if (auto lost = read_copy(file)) all.push_back(std::move(*lost));
    }
    std::sort(all.begin(), all.end(), [](const Lost& a, const Lost& b) { return a.when > b.when; });
    return all;
}

void Recovery::forget(const Lost& lost) {
    keep();  // if it was restored, it must not be lost between the two copies
    QFile::remove(lost.copy);
}

void Recovery::keep() {
    if (!document_.modified()) {
        QFile::remove(copy_);
        return;
    }
    try {
        io::AtomicFile file(file_name(copy_));
        file.write(copy_text(document_));
        file.commit();
        complained_ = false;
    } catch (const Error& error) {
        if (!std::exchange(complained_, true)) emit failed(QString::fromUtf8(error.what()));
    }
}

QString Recovery::default_folder() {
    return QStandardPaths::writableLocation(QStandardPaths::AppLocalDataLocation) + "/recovery";
}

}  // namespace asperity::studio
