// SPDX-License-Identifier: Apache-2.0
// Work in the background: the latest wish is answered, in the main thread, and nobody waits.
#include "model/background.h"

#include <asperity/core/error.h>

#include <QElapsedTimer>
#include <QProcess>
#include <QTest>
#include <QThread>

#include <atomic>
#include <cstdint>
#include <new>
#include <optional>
#include <vector>

namespace asperity::studio {
namespace {

constexpr int kSoon = 30000;

using Post = Background::Post;
using Delivery = Background::Delivery;

void work_until_stopped(Run& run) {
    while (run.keep_going()) QThread::msleep(1);
}

/// Leaves a job behind that hears nothing for a while, as a studio that is closed while it reads a
/// large file, and ends.
int leave_a_deaf_job() {
    static std::vector<unsigned> memory(1000, 1);  // gone when the program ends
    QObject owner;
    Background background(&owner, {});
    std::atomic<bool> begun = false;
    background.start([&begun](Run&, const Post&) -> Delivery {
        begun = true;
        QElapsedTimer timer;
        timer.start();
        std::uint64_t sum = 0;
        while (timer.elapsed() < 700)
            for (const unsigned one : memory) sum += one;
        std::fputs(sum > 0 ? "finished\n" : "", stdout);
        std::fflush(stdout);
        return {};
    });
    while (!begun) QThread::msleep(1);
    return 0;
}

}  // namespace

class BackgroundTest : public QObject {
    Q_OBJECT

  private slots:
    void delivers_in_the_main_thread();
    void the_latest_wins();
    void cancelled_is_cancelled();
    void errors_are_sentences();
    void a_delivery_may_end_it_all();
    void deaf_jobs_are_left_behind();
    void the_program_waits_for_the_deaf();
};

void BackgroundTest::delivers_in_the_main_thread() {
    Background background(this, {});
    std::vector<int> heard;
    bool all_here = true;
    const auto here = [&](int what) {
        all_here = all_here && QThread::currentThread() == thread();
        heard.push_back(what);
    };
    background.start([&](Run&, const Post& post) {
        all_here = all_here && QThread::currentThread() != thread();
        for (int k = 1; k <= 3; ++k) post([=] { here(k); });
        return [=] { here(4); };
    });
    QVERIFY(background.busy());
    QTRY_VERIFY_WITH_TIMEOUT(!background.busy(), kSoon);
    QCOMPARE(heard, (std::vector<int>{1, 2, 3, 4}));
    QVERIFY(all_here);
}

void BackgroundTest::the_latest_wins() {
    Background background(this, {});
    std::vector<int> heard;
    for (int k = 1; k <= 20; ++k)
        background.start([&heard, k](Run& run, const Post& post) {
            post([&heard, k] { heard.push_back(-k); });
            if (k < 20) work_until_stopped(run);
            return [&heard, k] { heard.push_back(k); };
        });
    QTRY_VERIFY_WITH_TIMEOUT(!background.busy(), kSoon);
    QCOMPARE(heard, (std::vector<int>{-20, 20}));
}

void BackgroundTest::cancelled_is_cancelled() {
    Background background(this, {});
    bool heard = false;
    background.start([&](Run&, const Post&) { return [&] { heard = true; }; });
    QThread::msleep(50);  // finished, but not delivered
    background.cancel();
    QVERIFY(!background.busy());
    QTest::qWait(50);
    QVERIFY(!heard);
}

void BackgroundTest::errors_are_sentences() {
    QStringList sentences;
    Background background(this, [&](const QString& sentence) { sentences += sentence; });
    background.start([](Run&, const Post&) -> Delivery {
        throw Error(ErrorCode::InvalidInput, "is half a file", "a.gsf:3");
    });
    QTRY_COMPARE_WITH_TIMEOUT(sentences, QStringList("a.gsf:3: is half a file"), kSoon);
    QVERIFY(!background.busy());
    background.start([](Run&, const Post&) -> Delivery { throw std::bad_alloc(); });
    QTRY_COMPARE_WITH_TIMEOUT(sentences.value(1), QString("out of memory"), kSoon);
}

void BackgroundTest::a_delivery_may_end_it_all() {
    auto background = std::make_unique<Background>(this, std::function<void(const QString&)>());
    background->start([&](Run&, const Post& post) {
        post([&] { background.reset(); });
        return [] { QFAIL("nobody should hear this"); };
    });
    QTRY_VERIFY_WITH_TIMEOUT(background == nullptr, kSoon);
    QTest::qWait(20);
}

void BackgroundTest::deaf_jobs_are_left_behind() {
    std::optional<Background> background(std::in_place, this, nullptr);
    const auto begun = std::make_shared<std::atomic<bool>>(false);
    background->start([begun](Run&, const Post& post) -> Delivery {
        *begun = true;
        QThread::msleep(500);
        post([] { QFAIL("nobody should hear this"); });
        return {};
    });
    QTRY_VERIFY_WITH_TIMEOUT(begun->load(), kSoon);
    QElapsedTimer timer;
    timer.start();
    background.reset();
    qInfo("left after %lld ms", timer.elapsed());
    QVERIFY(timer.elapsed() < 400);
    QTest::qWait(600);
}

void BackgroundTest::the_program_waits_for_the_deaf() {
    QProcess program;
    program.start(QCoreApplication::applicationFilePath(), {"--deaf"});
    QVERIFY(program.waitForFinished(kSoon));
    QCOMPARE(program.exitStatus(), QProcess::NormalExit);
    QCOMPARE(program.exitCode(), 0);
    QCOMPARE(program.readAllStandardOutput(), QByteArray("finished\n"));
}

}  // namespace asperity::studio

int main(int argc, char** argv) {
    const QCoreApplication application(argc, argv);
    if (argc == 2 && qstrcmp(argv[1], "--deaf") == 0) return asperity::studio::leave_a_deaf_job();
    asperity::studio::BackgroundTest test;
    return QTest::qExec(&test, argc, argv);
}
#include "background_test.moc"
