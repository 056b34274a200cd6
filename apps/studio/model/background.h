// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <asperity/core/run.h>

#include <QObject>
#include <QString>

#include <exception>
#include <functional>
#include <memory>
#include <thread>

namespace asperity::studio {

/// Computes in a thread of its own what was asked for last.
///
/// Lives in the main thread, as part of `owner`. What a job posts and what it returns is called in
/// the main thread, one after the other; of a job that was overtaken or cancelled nothing arrives.
class Background {
  public:
    using Delivery = std::function<void()>;
    using Post = std::function<void(Delivery)>;
    /// Called in the background: the work, and what is to be done with its result. May throw; may
    /// post what there is to show on the way.
    using Job = std::function<Delivery(Run&, const Post&)>;

    /// `failed` hears, in the main thread, the sentence of what a job threw.
    Background(QObject* owner, std::function<void(const QString&)> failed);
    /// Returns within 100 ms: a job that does not hear the stop in time is left to end unheard.
    ~Background();
    Background(const Background&) = delete;
    Background& operator=(const Background&) = delete;

    /// Stops the job under way, if any, and begins this one when that has ended. Does not wait.
    void start(Job job, std::shared_ptr<Run> run = std::make_shared<Run>());
    void cancel();
    bool busy() const;

  private:
    struct Order;
    struct Shared;
    static void work(const std::shared_ptr<Shared>& shared);
    static void carry_out(const std::shared_ptr<Shared>& shared, const Order& order);
    static void post(const std::shared_ptr<Shared>& shared, std::uint64_t serial, Delivery task);

    std::shared_ptr<Shared> shared_;
    std::thread thread_;
};

/// What `error` says, as the CLI prints it.
QString sentence_of(const std::exception_ptr& error);

}  // namespace asperity::studio
