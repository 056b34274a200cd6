// SPDX-License-Identifier: Apache-2.0
#include <asperity/params/settings_text.h>

#include <asperity/params/fields.h>

#include <gtest/gtest.h>

namespace asperity {
namespace {

TEST(SettingsText, LinesReadBack) {
    for (const char* value :
         {"plain", "", " spaced ", "a # b", "\"q\" \\", "two\nlines\r", "[x]"}) {
        const auto settings = parse_settings(setting_line("file-name", value), "e.txt");
        ASSERT_EQ(settings.size(), 1u);
        EXPECT_EQ(settings[0].key, "file-name");
        EXPECT_EQ(settings[0].value, value);
    }
}

TEST(SettingsText, LinesKnowTheirPlace) {
    const auto settings = parse_settings(
        "\xef\xbb\xbf# a comment\r\n\n  size = 8 # small\r\n[lamp]\nsize=9", "e.txt");
    ASSERT_EQ(settings.size(), 2u);
    EXPECT_EQ(settings[0].value, "8");
    EXPECT_EQ(settings[0].line, 3);
    EXPECT_EQ(settings[0].section, "");
    EXPECT_EQ(settings[1].line, 5);
    EXPECT_EQ(settings[1].section, "lamp");
    for (const char* line : {"[", "[]", "[A b]", "[run] seed = 1", "size", "Size = 2", "a = \"2"})
        try {
            parse_settings(std::string("size = 8\n") + line, "e.txt");
            ADD_FAILURE() << line;
        } catch (const Error& error) {
            EXPECT_EQ(error.code(), ErrorCode::InvalidInput);
            EXPECT_EQ(error.where(), "e.txt:2");
        }
}

TEST(SettingsText, GroupsAreHeadings) {
    struct Lantern {
        int bulbs = 3;
        double power = 40;
        bool on = true;
    };
    ParamTable<Lantern> table = {
        field(&Lantern::bulbs, {.name = "bulbs", .group = "Lantern"}),
        field(&Lantern::power, {.name = "power", .group = "Lantern"}),
        field(&Lantern::on, {.name = "on", .group = "Wall"}),
    };
    table.push_back(
        field(&Lantern::on, {.name = "new", .group = "Wall", .written_where_used = true}));
    table.back().unused = [](const Lantern& l) { return l.on ? "the lamp is on" : ""; };
    EXPECT_EQ(settings_text(table, Lantern{}),
              "# Lantern\nbulbs = 3\npower = 40\n# Wall\non = true\n");
}

}  // namespace
}  // namespace asperity
