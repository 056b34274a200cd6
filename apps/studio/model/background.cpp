// SPDX-License-Identifier: Apache-2.0
#include "background.h"

#include <asperity/core/error.h>

#include <chrono>
#include <condition_variable>
#include <cstdlib>
#include <exception>
#include <mutex>
#include <new>
#include <optional>

namespace asperity::studio {

namespace {

/// Threads that were left to end on their own. The program waits for them at its very end, without
/// its windows, for they must not run while it is taken down.
class Stragglers {
  public:
    static Stragglers& all() {
        static Stragglers stragglers;
        return stragglers;
    }
    void one_more() {
        const std::scoped_lock lock(mutex_);
        ++count_;
        // Called last first: before anything goes that was there when the thread was left
        std::atexit([] { all().wait(); });
    }
    void one_less() {
        const std::scoped_lock lock(mutex_);
        --count_;
        none_left_.notify_all();
    }

  private:
    void wait() {
        std::unique_lock lock(mutex_);
        none_left_.wait_for(lock, std::chrono::seconds(20), [&] { return count_ == 0; });
    }

    std::mutex mutex_;
    std::condition_variable none_left_;
    int count_ = 0;
};

}  // namespace

struct Background::Order {
    std::uint64_t serial = 0;
    Job job;
    std::shared_ptr<Run> run;
};

/// What the thread holds on to, so that it may outlive the Background.
struct Background::Shared {
    std::mutex mutex;  ///< for all that follows
    std::condition_variable wake, ended;
    QObject* owner = nullptr;  ///< null: nobody listens any more
    std::function<void(const QString&)> failed;
    std::uint64_t serial = 0;  ///< of the latest wish
    bool busy = false, quit = false, finished = false, left_behind = false;
    std::optional<Order> next;
    std::shared_ptr<Run> running;

    void stop_running() {
        next.reset();
        if (running) running->request_stop();
    }
};

Background::Background(QObject* owner, std::function<void(const QString&)> failed)
    : shared_(std::make_shared<Shared>()) {
    shared_->owner = owner;
    shared_->failed = std::move(failed);
}

Background::~Background() {
    if (!thread_.joinable()) return;
    std::unique_lock lock(shared_->mutex);
    shared_->owner = nullptr;
    shared_->quit = true;
    ++shared_->serial;
    shared_->stop_running();
    shared_->wake.notify_one();
    const bool ended = shared_->ended.wait_for(lock, std::chrono::milliseconds(80),
                                               [&] { return shared_->finished; });
    shared_->left_behind = !ended;
    if (!ended) Stragglers::all().one_more();
    lock.unlock();
    if (ended)
        thread_.join();
    else
        thread_.detach();
}

void Background::start(Job job, std::shared_ptr<Run> run) {
    {
        const std::scoped_lock lock(shared_->mutex);
        shared_->stop_running();
        shared_->busy = true;
        shared_->next = Order{++shared_->serial, std::move(job), std::move(run)};
    }
    if (!thread_.joinable()) thread_ = std::thread([shared = shared_] { work(shared); });
    shared_->wake.notify_one();
}

void Background::cancel() {
    const std::scoped_lock lock(shared_->mutex);
    ++shared_->serial;
    shared_->busy = false;
    shared_->stop_running();
}

bool Background::busy() const {
    const std::scoped_lock lock(shared_->mutex);
    return shared_->busy;
}

void Background::work(const std::shared_ptr<Shared>& shared) {
    std::unique_lock lock(shared->mutex);
    while (true) {
        shared->wake.wait(lock, [&] { return shared->quit || shared->next; });
        if (shared->quit) break;
        const Order order = std::move(*shared->next);
        shared->next.reset();
        shared->running = order.run;
        lock.unlock();
        carry_out(shared, order);
        lock.lock();
        shared->running.reset();
    }
    shared->finished = true;
    shared->ended.notify_one();
    if (shared->left_behind) Stragglers::all().one_less();
}

void Background::carry_out(const std::shared_ptr<Shared>& shared, const Order& order) {
    Delivery delivery;
    try {
        delivery = order.job(*order.run, [shared, serial = order.serial](Delivery task) {
            post(shared, serial, std::move(task));
        });
    } catch (...) {
        const QString sentence = sentence_of(std::current_exception());
        delivery = [shared, sentence] { shared->failed(sentence); };
    }
    post(shared, order.serial, [shared, delivery] {
        {
            const std::scoped_lock lock(shared->mutex);
            shared->busy = false;
        }
        if (delivery) delivery();
    });
}

void Background::post(const std::shared_ptr<Shared>& shared, std::uint64_t serial, Delivery task) {
    // The lock keeps the owner alive while it is sent something
    const std::scoped_lock lock(shared->mutex);
    if (shared->owner == nullptr || shared->serial != serial) return;
    const auto deliver = [shared, serial, task = std::move(task)] {
        {
            const std::scoped_lock still(shared->mutex);
            if (shared->serial != serial) return;
        }
        task();
    };
    QMetaObject::invokeMethod(shared->owner, deliver, Qt::QueuedConnection);
}

QString sentence_of(const std::exception_ptr& error) {
    try {
        std::rethrow_exception(error);
    } catch (const std::bad_alloc&) {
        return QStringLiteral("out of memory");
    } catch (const std::exception& e) {
        return QString::fromStdString(e.what());
    }
}

}  // namespace asperity::studio
