// SPDX-License-Identifier: Apache-2.0
#include "errand.h"

#include <asperity/core/error.h>

#include <QCoreApplication>

#include <chrono>
#include <condition_variable>
#include <mutex>
#include <new>
#include <thread>
#include <utility>
#include <vector>

namespace asperity::studio {

namespace {

/// Threads that were busy with what cannot be stopped (a file being read) when nobody wanted it any
/// more.
class LeftBehind {
  public:
    static LeftBehind& all() {
        static LeftBehind threads;
        return threads;
    }
    void add(std::thread thread) {
        const std::lock_guard lock(mutex_);
        threads_.push_back(std::move(thread));
    }
    void wait() {
        const std::lock_guard lock(mutex_);
        for (std::thread& thread : threads_) thread.join();
        threads_.clear();
    }
    ~LeftBehind() { wait(); }

  private:
    LeftBehind() {
        qAddPostRoutine([] { all().wait(); });  // before statics that they may use are gone
    }

    std::mutex mutex_;
    std::vector<std::thread> threads_;
};

QString sentence_of(const std::exception& error) {
    if (dynamic_cast<const std::bad_alloc*>(&error) != nullptr)
        return QStringLiteral("there is not enough memory");
    return QString::fromUtf8(error.what());
}

}  // namespace

/// What the thread and the main thread share; outlives the Errand when the thread does.
struct Errand::Shared {
    std::mutex mutex;
    std::condition_variable ended;
    std::thread thread;
    bool running = false;      ///< the thread
    QObject* home = nullptr;   ///< null: nobody waits any more
    Errand* errand = nullptr;  ///< main thread only
    Failed failed;             ///< main thread only
    std::uint64_t wish = 0;    ///< counts up
    Work next;                 ///< to be done after what is under way
    std::shared_ptr<Run> run;  ///< of what is under way
};

Errand::Errand(QObject* home, Failed failed) : shared_(std::make_shared<Shared>()) {
    shared_->home = home;
    shared_->errand = this;
    shared_->failed = std::move(failed);
}

Errand::~Errand() {
    using namespace std::chrono_literals;
    std::unique_lock lock(shared_->mutex);
    shared_->home = nullptr;
    shared_->errand = nullptr;
    shared_->next = nullptr;
    if (shared_->run != nullptr) shared_->run->request_stop();
    const bool over = shared_->ended.wait_for(lock, 50ms, [this] { return !shared_->running; });
    std::thread thread = std::move(shared_->thread);
    lock.unlock();
    if (!thread.joinable()) return;
    if (over) {
        thread.join();
    } else {
        LeftBehind::all().add(std::move(thread));
    }
}

void Errand::start(Work work) {
    const std::lock_guard lock(shared_->mutex);
    ++shared_->wish;
    busy_ = true;
    shared_->next = std::move(work);
    if (shared_->running) {
        if (shared_->run != nullptr) shared_->run->request_stop();
        return;
    }
    if (shared_->thread.joinable()) shared_->thread.join();  // it has said that it is at its end
    shared_->running = true;
    shared_->thread = std::thread([shared = shared_] { work_on(shared); });
}

void Errand::stop() {
    const std::lock_guard lock(shared_->mutex);
    ++shared_->wish;
    busy_ = false;
    shared_->next = nullptr;
    if (shared_->run != nullptr) shared_->run->request_stop();
}

Progress Errand::progress() const {
    const std::lock_guard lock(shared_->mutex);
    return shared_->run != nullptr ? shared_->run->progress() : Progress{};
}

void Errand::work_on(const std::shared_ptr<Shared>& shared) {
    std::unique_lock lock(shared->mutex);
    while (shared->next) {
        // Take the latest wish
        const Work work = std::exchange(shared->next, nullptr);
        const std::uint64_t wish = shared->wish;
        const auto run = std::make_shared<Run>();
        shared->run = run;
        lock.unlock();

        // Do it
        Delivery delivery;
        try {
            delivery = work(*run);
        } catch (const std::exception& error) {
            const auto* known = dynamic_cast<const Error*>(&error);
            if (known == nullptr || known->code() != ErrorCode::Stopped)
                delivery = [shared, said = sentence_of(error)] { shared->failed(said); };
        }

        // Hand it over, unless another is wanted by then
        lock.lock();
        shared->run = nullptr;
        if (shared->home == nullptr || shared->wish != wish) continue;
        const auto deliver = [shared, wish, delivery] {
            if (shared->errand == nullptr || shared->wish != wish) return;
            shared->errand->busy_ = false;
            if (delivery) delivery();
        };
        QMetaObject::invokeMethod(shared->home, deliver, Qt::QueuedConnection);
    }
    shared->running = false;
    shared->ended.notify_all();
}

}  // namespace asperity::studio
