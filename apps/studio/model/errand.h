// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <asperity/core/run.h>

#include <QObject>
#include <QString>

#include <functional>
#include <memory>

namespace asperity::studio {

/// Work that a thread does for an object of the main thread: of several wishes the latest is
/// delivered, the one under way is asked to stop and finished or abandoned first.
///
/// Lives in the main thread as a member of the object it works for.
class Errand {
  public:
    /// What to do in the main thread with what was found.
    using Delivery = std::function<void()>;
    /// Done in the thread. Touches nothing but what it holds itself. What it throws is delivered as
    /// a sentence; nothing is delivered when it throws Error(Stopped).
    using Work = std::function<Delivery(Run&)>;
    using Failed = std::function<void(const QString& sentence)>;

    Errand(QObject* home, Failed failed);
    /// Stops; returns within 100 ms: a thread that does not hear is left behind, to be waited for
    /// when the application ends.
    ~Errand();

    void start(Work work);
    void stop();  ///< nothing will be delivered

    bool busy() const { return busy_; }  ///< a delivery is still to come
    Progress progress() const;           ///< of the work under way

  private:
    struct Shared;
    static void work_on(const std::shared_ptr<Shared>& shared);

    std::shared_ptr<Shared> shared_;
    bool busy_ = false;
};

}  // namespace asperity::studio
