// SPDX-License-Identifier: Apache-2.0
#include "expect.h"
#include "run_check.h"

#include <asperity/core/error.h>

#include <gtest/gtest.h>

#include <cmath>
#include <set>
#include <vector>

namespace asperity::checks {
namespace {

TEST(Checks, ThesisChecksPassOneByOne) {
    asperity::Run run(2);
    std::set<std::string> names;
    check_thesis(run, [&](const std::string& name, const std::string& failure) {
        EXPECT_EQ(failure, "") << name;
        EXPECT_TRUE(names.insert(name).second) << name << " came twice";
    });
    EXPECT_EQ(names.size(), std::size_t{kThesisChecks});
}

TEST(Checks, PhysicsChecksPass) {
    asperity::Run run(2);
    int done = 0;
    const CheckReport report = [&](const std::string& name, const std::string& failure) {
        EXPECT_EQ(failure, "") << name;
        ++done;
    };
    check_surfaces(run, report);
    check_light(run, report);
    check_reflection(run, report);
    check_statistics(run, report);
    EXPECT_EQ(done, 42);
}

TEST(Checks, ExpectationsRefuseWhatIsNoNumber) {
    EXPECT_EQ(expect_near("it", 1.5, 1, 0.5), "");
    EXPECT_EQ(expect_near("it", 1.75, 1, 0.5), "it is 1.75, not 1");
    EXPECT_EQ(expect_near("it", std::nan(""), 1, 0.5), "it is nan, not 1");
    EXPECT_EQ(first_of({"", "b", "c"}), "b");
    EXPECT_EQ(first_of({"", ""}), "");
}

TEST(Checks, AStopEndsThemWithoutABadWord) {
    asperity::Run run(2);
    int reported = 0;
    const CheckReport report = [&](const std::string& name, const std::string& failure) {
        EXPECT_EQ(failure, "") << name;
        if (++reported == 20) run.request_stop();
    };
    try {
        check_thesis(run, report);
        ADD_FAILURE() << "was not stopped";
    } catch (const Error& error) {
        EXPECT_EQ(error.code(), ErrorCode::Stopped);
    }
    EXPECT_EQ(reported, 20);

    // A check that is cut short is neither passed nor failed
    asperity::Run other(1);
    EXPECT_THROW(run_check(other, report, "cut short",
                           [&]() -> std::string {
                               other.request_stop();
                               return "half of it is missing";
                           }),
                 Error);
    EXPECT_EQ(reported, 20);
}

TEST(Checks, AnErrorIsAFailure) {
    const asperity::Run run(1);
    std::vector<std::string> failures;
    const CheckReport report = [&](const std::string&, const std::string& failure) {
        failures.push_back(failure);
    };
    run_check(run, report, "throws",
              []() -> std::string { throw Error(ErrorCode::InputOutput, "no disk", "a.obj"); });
    run_check(run, report, "fails", [] { return std::string("is 2, not 1"); });
    run_check(run, report, "passes", [] { return std::string(); });
    EXPECT_EQ(failures, (std::vector<std::string>{"a.obj: no disk", "is 2, not 1", ""}));
}

}  // namespace
}  // namespace asperity::checks
