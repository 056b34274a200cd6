// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "document.h"

#include <QDateTime>
#include <QLockFile>
#include <QObject>
#include <QString>
#include <QTimer>

#include <memory>
#include <vector>

namespace asperity::studio {

/// Keeps what is not saved yet, so that a killed studio loses a few seconds of work at most.
///
/// While the document differs from its file, a copy of the session lies in the recovery folder
/// under the number of this process; a clean end takes it away. A copy whose process is dead is
/// what `recoverable` lists.
class Recovery : public QObject {
    Q_OBJECT

  public:
    /// A session that its studio did not take away.
    struct Lost {
        StudioSettings settings;
        QString path;  ///< it was opened from or saved to; empty: never saved
        QDateTime when;
        QString copy;  ///< file of the recovery folder
    };

    explicit Recovery(Document& document, const QString& folder = default_folder(),
                      QObject* parent = nullptr);
    ~Recovery() override;  ///< the clean end

    /// Those of dead processes, latest first. A copy that cannot be read is no session: left out.
    std::vector<Lost> recoverable() const;
    /// Removes the copy: the user has it back, or does not want it.
    void forget(const Lost& lost);

    /// Writes the copy now, if the document is modified, else removes it. Called by itself a few
    /// seconds after a change.
    void keep();
    void set_delay(int milliseconds) { timer_.setInterval(milliseconds); }

    static QString default_folder();

  signals:
    void failed(const QString& sentence);  ///< once, until a copy succeeds again

  private:
    Document& document_;
    QString folder_, copy_;
    std::unique_ptr<QLockFile> lock_;
    QTimer timer_;
    bool complained_ = false;
};

}  // namespace asperity::studio
