// SPDX-License-Identifier: Apache-2.0
// A studio that is killed loses nothing that is older than a few seconds. The test runs itself as
// the process to be killed: `recovery_test --victim FOLDER`.
#include "model/recovery.h"
#include "model/session_text.h"

#include <QCoreApplication>
#include <QDir>
#include <QFile>
#include <QProcess>
#include <QSignalSpy>
#include <QTemporaryDir>
#include <QTest>

namespace asperity::studio {
namespace {

constexpr int kSoon = 30000;

QStringList copies(const QTemporaryDir& folder) {
    return QDir(folder.path()).entryList({"session-*.txt"}, QDir::Files);
}

void edit(Document& document, int bounces) {
    document.change("Ray Bounces", [=](auto& s) { s.experiment.run.bounces = bounces; });
}

/// Works on a session until it is killed.
int be_victim(const QString& folder) {
    Document document;
    Recovery recovery(document, folder);
    recovery.set_delay(20);
    document.save(folder + "/mine.txt");
    edit(document, 9);
    return QCoreApplication::exec();
}

}  // namespace

class RecoveryTest : public QObject {
    Q_OBJECT

  private slots:
    void keeps_what_is_not_saved();
    void clean_end_leaves_nothing();
    void restores_after_a_kill();
    void leaves_the_living_alone();
    void skips_what_is_no_session();
    void tells_once_that_it_cannot();
};

void RecoveryTest::keeps_what_is_not_saved() {
    const QTemporaryDir folder, files;
    Document document;
    Recovery recovery(document, folder.path());
    recovery.set_delay(20);
    QTest::qWait(100);
    QCOMPARE(copies(folder).size(), 0);  // nothing to lose yet

    edit(document, 5);
    QTRY_COMPARE_WITH_TIMEOUT(copies(folder).size(), 1, kSoon);
    document.save(files.filePath("a.txt"));
    QTRY_COMPARE_WITH_TIMEOUT(copies(folder).size(), 0, kSoon);
    document.undo_stack().undo();
    QTRY_COMPARE_WITH_TIMEOUT(copies(folder).size(), 1, kSoon);
}

void RecoveryTest::clean_end_leaves_nothing() {
    const QTemporaryDir folder;
    {
        Document document;
        Recovery recovery(document, folder.path());
        edit(document, 5);
        recovery.keep();
        QCOMPARE(copies(folder).size(), 1);
    }
    QVERIFY(QDir(folder.path()).isEmpty());
}

void RecoveryTest::restores_after_a_kill() {
    const QTemporaryDir folder;
    QProcess victim;
    victim.start(QCoreApplication::applicationFilePath(), {"--victim", folder.path()});
    QVERIFY(victim.waitForStarted());
    QTRY_COMPARE_WITH_TIMEOUT(copies(folder).size(), 1, kSoon);
    Document document;
    Recovery recovery(document, folder.path());
    QVERIFY(recovery.recoverable().empty());  // it lives

    victim.kill();
    QVERIFY(victim.waitForFinished());
    const auto lost = recovery.recoverable();
    QCOMPARE(lost.size(), 1U);
    QCOMPARE(lost.front().settings.experiment.run.bounces, 9);
    QCOMPARE(lost.front().path, folder.filePath("mine.txt"));
    QVERIFY(lost.front().when.secsTo(QDateTime::currentDateTime()) < 60);

    document.restore(lost.front().settings, lost.front().path);
    QVERIFY(document.modified());
    QCOMPARE(document.path(), folder.filePath("mine.txt"));
    recovery.forget(lost.front());
    QVERIFY(recovery.recoverable().empty());
    QCOMPARE(copies(folder).size(), 1);  // ours, at once: nothing is lost in between
}

void RecoveryTest::leaves_the_living_alone() {
    const QTemporaryDir folder;
    Document one, two;
    Recovery first(one, folder.path()), second(two, folder.path());
    edit(one, 3);
    first.keep();
    QVERIFY(first.recoverable().empty());
    QVERIFY(second.recoverable().empty());
    edit(two, 4);
    second.keep();
    QCOMPARE(copies(folder).size(), 2);
}

void RecoveryTest::skips_what_is_no_session() {
    const QTemporaryDir folder;
    QFile file(folder.filePath("session-1-0.txt"));
    QVERIFY(file.open(QIODevice::WriteOnly));
    file.write("half of a li");
    file.close();
    Document document;
    Recovery recovery(document, folder.path());
    QVERIFY(recovery.recoverable().empty());
}

void RecoveryTest::tells_once_that_it_cannot() {
    const QTemporaryDir folder;
    QFile blocked(folder.filePath("file"));
    QVERIFY(blocked.open(QIODevice::WriteOnly));
    Document document;
    Recovery recovery(document, folder.filePath("file/within"));
    QSignalSpy failed(&recovery, &Recovery::failed);
    edit(document, 3);
    recovery.keep();
    recovery.keep();
    QCOMPARE(failed.count(), 1);
}

}  // namespace asperity::studio

int main(int argc, char** argv) {
    QCoreApplication application(argc, argv);
    const QStringList arguments = QCoreApplication::arguments();
    if (arguments.size() == 3 && arguments[1] == "--victim")
        return asperity::studio::be_victim(arguments[2]);
    asperity::studio::RecoveryTest test;
    return QTest::qExec(&test, argc, argv);
}
#include "recovery_test.moc"
