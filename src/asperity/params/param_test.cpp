// SPDX-License-Identifier: Apache-2.0
#include <asperity/params/fields.h>

#include <gtest/gtest.h>

#include <cfloat>

namespace asperity {
namespace {

enum class Colour { Red, Blue };
constexpr Names<Colour, 2> kColours = {{{"red", Colour::Red}, {"blue", Colour::Blue}}};

struct Lamp {
    bool on = true;
    int bulbs = 3;
    std::uint64_t seed = 1, rays = 0;
    double power = 40, share = 0.5;
    std::string maker;
    std::vector<double> angles;
    Colour colour = Colour::Blue;
    double x = 1, y = 1;
    std::optional<double> u, v;
    bool operator==(const Lamp&) const = default;
};

ParamTable<Lamp> lamp_params() {
    ParamTable<Lamp> table = {
        field(&Lamp::on, {.name = "on", .group = "Lamp"}),
        field(&Lamp::bulbs, {.name = "bulbs", .group = "Lamp", .range = {1, 9}}),
        field(&Lamp::seed, {.name = "seed"}),
        field(&Lamp::rays, {.name = "rays", .range = {2, 1e9}, .absent = "auto"}),
        field(&Lamp::power, {.name = "power-used", .unit = "W", .range = {0, 100, true}}),
        field(&Lamp::maker, {.name = "maker", .absent = "none"}),
        field(&Lamp::angles,
              {.name = "angles", .range = kBelowHorizon, .absent = "none", .most = 3}),
        field(&Lamp::colour, kColours, {.name = "colour"}),
        pair_field(&Lamp::x, &Lamp::y, {.name = "size", .range = kAboveZero}),
        field(&Lamp::share, {.name = "share", .range = {0, 1, true}, .percent = true}),
        pair_field(&Lamp::u, &Lamp::v, {.name = "cell", .range = kAboveZero}),
    };
    table[1].unused = [](const Lamp& l) { return std::string(l.on ? "" : "the lamp is off"); };
    return table;
}

struct Case {
    const char *name, *text, *shown;
};

TEST(Param, TextAndBack) {
    const auto table = lamp_params();
    for (const Case& c : {Case{"on", "no", "false"},
                          Case{"on", "1", "true"},
                          Case{"bulbs", " 7 ", "7"},
                          Case{"seed", "18446744073709551615", nullptr},
                          Case{"seed", "9007199254740993", nullptr},
                          Case{"rays", "1e6", "1000000"},
                          Case{"rays", "auto", nullptr},
                          Case{"power-used", "0.1", nullptr},
                          Case{"maker", " a,b ", nullptr},
                          Case{"maker", "none", nullptr},
                          Case{"angles", "0, 89.5", "0,89.5"},
                          Case{"angles", "", "none"},
                          Case{"angles", "0:80:40", "0,40,80"},
                          Case{"angles", "80 : 0 : -40", "80,40,0"},
                          Case{"angles", "0.1:0.3:0.1", "0.1,0.2,0.3"},
                          Case{"angles", "5,0:19:10", "5,0,10"},
                          Case{"angles", "7:7:1", "7"},
                          Case{"colour", "red", nullptr},
                          Case{"size", "0.25", nullptr},
                          Case{"size", "0.5,0.5", "0.5"},
                          Case{"size", "2,3", nullptr},
                          Case{"cell", "auto,2", nullptr},
                          Case{"cell", "auto", nullptr}}) {
        const Param<Lamp>* param = find(table, c.name);
        ASSERT_NE(param, nullptr) << c.name;
        Lamp lamp, again;
        param->apply(lamp, c.text);
        EXPECT_EQ(param->text(lamp), c.shown ? c.shown : c.text) << c.name;
        param->apply(again, param->text(lamp));
        EXPECT_EQ(again, lamp) << c.name << " = " << c.text;
    }
    EXPECT_EQ(find(table, "color"), nullptr);
}

TEST(Param, ValuesKeepTheirTypes) {
    const auto table = lamp_params();
    const auto value = [&](const char* name) { return find(table, name)->get(Lamp{}); };
    EXPECT_EQ(value("bulbs"), ParamValue(std::int64_t{3}));
    EXPECT_EQ(value("seed"), ParamValue(std::uint64_t{1}));
    EXPECT_EQ(value("rays"), ParamValue());
    EXPECT_EQ(value("power-used"), ParamValue(40.0));
    EXPECT_EQ(value("colour"), ParamValue(std::string("blue")));
    EXPECT_EQ(value("size"), ParamValue(std::vector{1.0, 1.0}));
    EXPECT_EQ(find(table, "size")->default_text(), "1");
}

void expect_refused(const char* name, const char* text, const std::string& why) {
    const auto table = lamp_params();
    const Lamp before;
    Lamp lamp;
    try {
        find(table, name)->apply(lamp, text);
        ADD_FAILURE() << name << " took '" << text << "'";
    } catch (const Error& error) {
        EXPECT_EQ(error.code(), ErrorCode::Usage);
        EXPECT_EQ(error.where(), name);
        EXPECT_EQ(error.message(), why);
    }
    EXPECT_EQ(lamp, before);
}

TEST(Param, RefusesWithTheRule) {
    expect_refused("on", "maybe", "'maybe' is neither true nor false");
    expect_refused("bulbs", "2.5", "'2.5' is not a whole number");
    expect_refused("bulbs", "10", "'10' must be in 1 .. 9");
    expect_refused("bulbs", "1e300", "'1e300' is not a whole number");
    expect_refused("seed", "-1", "'-1' is not a whole number in 0 .. 2^64 - 1");
    expect_refused("seed", "18446744073709551616",
                   "'18446744073709551616' is not a whole number in 0 .. 2^64 - 1");
    expect_refused("rays", "1", "'1' must be in 2 .. 1e+09");
    expect_refused("power-used", "0", "'0' must be above 0 and at most 100 W");
    expect_refused("power-used", "nan", "'nan' is not a number");
    expect_refused("angles", "0,90", "'90' must be at least 0 and below 90");
    expect_refused("angles", "1,2,3,4", "'1,2,3,4' is more than 3 numbers");
    expect_refused("angles", "1,", "'' is not a number");
    expect_refused("angles", "0:30:10", "'0:30:10' is more than 3 numbers");
    expect_refused("angles", "0:80", "'0:80' is not start:stop:step, such as 0:80:10");
    expect_refused("angles", "0:80:0:1", "'0:80:0:1' is not start:stop:step, such as 0:80:10");
    expect_refused("angles", "0:80:-40", "'0:80:-40' never comes from 0 to 80");
    expect_refused("angles", "1:1:0", "'1:1:0' never comes from 1 to 1");
    expect_refused("angles", "0:80:1e-9", "'0:80:1e-9' is more than 10000 numbers");
    expect_refused("angles", "0:120:60", "'120' must be at least 0 and below 90");
    expect_refused("colour", "bleu", "'bleu' is none of red, blue; did you mean blue?");
    expect_refused("size", "0,3", "'0' must be above 0; did you mean 0.3?");
    expect_refused("bulbs", "2k", "'2k' is not a whole number; did you mean 2e3?");
    expect_refused("bulbs", "4x4", "'4x4' is not a whole number; did you mean 4?");
    expect_refused("share", "2", "'2' must be above 0 and at most 1; did you mean 2%?");
    expect_refused("power-used", "4 px", "'4 px' is not a number; it is taken in W");
    expect_refused("share", "4 px", "'4 px' is not a number; write 4, it is taken without a unit");
    expect_refused("power-used", "40%", "'40%' is not a number; did you mean 0.4?");
    expect_refused("power-used", "2,5", "'2,5' is not a number; did you mean 2.5?");
    expect_refused("colour", "green", "'green' is none of red, blue");
    expect_refused("size", "1,2,3", "'1,2,3' is more than 2 numbers");
    expect_refused("size", "auto", "'auto' is not a number");
    expect_refused("cell", "auto,0", "'0' must be above 0");
}

TEST(Param, RangesHaveEnds) {
    EXPECT_TRUE((Range{0, 1}.contains(0)));
    EXPECT_FALSE((Range{0, 1, true}.contains(0)));
    EXPECT_TRUE((Range{0, 1, true}.contains(DBL_TRUE_MIN)));
    EXPECT_FALSE((Range{0, 1, false, true}.contains(1)));
    EXPECT_FALSE(kAnyNumber.contains(std::nan("")));
    EXPECT_EQ(kNotNegative.rule(), "must not be negative");
    EXPECT_EQ((Range{2, 9}.text()), "2 .. 9");
    EXPECT_EQ((Range{0, 1, true}.text()), "above 0, at most 1");
    EXPECT_EQ(kAnyNumber.text(), "");
}

TEST(Param, ChecksWholeTables) {
    Lamp lamp;
    EXPECT_NO_THROW(check_all(lamp_params(), lamp));
    lamp.bulbs = 20;
    EXPECT_THROW(check_all(lamp_params(), lamp), Error);
    lamp.on = false;
    EXPECT_FALSE(find(lamp_params(), "bulbs")->used(lamp));
    EXPECT_TRUE(find(lamp_params(), "seed")->used(lamp));
    lamp.bulbs = 3;
    lamp.x = std::nan("");
    EXPECT_THROW(check_all(lamp_params(), lamp), Error);
}

TEST(Param, PartsOfAWhole) {
    struct Room {
        Lamp lamp;
    };
    ParamTable<Room> table;
    append(table, lamp_params(), &Room::lamp);
    Room room;
    find(table, "bulbs")->apply(room, "5");
    EXPECT_EQ(room.lamp.bulbs, 5);
    EXPECT_EQ(find(table, "bulbs")->text(room), "5");
    room.lamp.on = false;
    EXPECT_EQ(find(table, "bulbs")->unused(room), "the lamp is off");
}

TEST(Param, WordsOfForms) {
    EXPECT_EQ(label({.name = "correlation-length"}), "Correlation Length");
    EXPECT_EQ(label({.name = "jitter", .label = "Camera Jitter"}), "Camera Jitter");
    EXPECT_EQ(
        help_text(
            {.name = "a", .unit = "cells", .range = {1, 9}, .doc = "a width", .users = "ggx"}),
        "ggx: a width; 1 .. 9 cells");
    EXPECT_EQ(help_text({.name = "a", .unit = "cells", .doc = "a width"}), "a width, in cells");
    EXPECT_EQ(metavar(find(lamp_params(), "size")->info), "X[,Y]");
    EXPECT_EQ(metavar(find(lamp_params(), "on")->info), "");
}

}  // namespace
}  // namespace asperity
