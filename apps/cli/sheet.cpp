// SPDX-License-Identifier: Apache-2.0
// asperity sheet: rendered pictures side by side, through one tone mapping.
#include "console.h"
#include "file_kind.h"
#include "help.h"
#include "options.h"
#include "output_path.h"
#include "render_options.h"
#include "verbs.h"

#include <asperity/core/error.h>
#include <asperity/formats/images/image_reader.h>
#include <asperity/pictures/canvas.h>
#include <asperity/pictures/png_writer.h>
#include <asperity/pictures/stroke_font.h>

#include <fmt/format.h>

#include <cmath>
#include <memory>

namespace asperity::cli {

namespace {

constexpr const char* kSheetClosing =
    "All pictures go through the same tone mapping with the same exposure: what differs in the\n"
    "sheet differs in the light. They must be of one size. Pictures fill the rows from the left.\n"
    "\n"
    "Examples\n"
    "  asperity sheet measured.exr model.exr --heads measured,Cook-Torrance -o sheet.png\n"
    "  asperity sheet a.exr b.exr c.exr d.exr --columns 2 --labels 0.2,0.4,0.6,0.8 -o sheet.png\n";

constexpr io::Colour kPaper = {1, 1, 1}, kInk = {0.13, 0.13, 0.15}, kFaintInk = {0.4, 0.4, 0.43};

/// Where the pictures and the words of a sheet stand [pixels].
struct Layout {
    int columns, rows, width, height;  ///< of a picture: width, height
    bool title, heads, labels;

    int margin() const { return std::max(16, width / 16); }
    int gap() const { return std::max(6, width / 40); }
    double letters() const { return std::max(12.0, width / 18.0); }
    int line() const { return static_cast<int>(1.6 * letters()); }

    int left(int column) const { return margin() + column * (width + gap()); }
    int top(int row) const {
        const int above = margin() + (title ? 2 * line() : 0) + (heads ? line() : 0);
        return above + row * (height + (labels ? line() : 0) + gap());
    }
    int sheet_width() const { return left(columns) - gap() + margin(); }
    int sheet_height() const { return top(rows) - gap() + margin(); }
};

std::vector<std::string> words_of(const CLI::Option* option) {
    std::vector<std::string> words;
    if (option->count() == 0) return words;
    const std::string text = text_of(option);
    for (const std::string_view word : split(text, ',')) words.emplace_back(word);
    return words;
}

void check_count(const char* name, const std::vector<std::string>& words, std::size_t wanted,
                 const char* things) {
    if (words.empty() || words.size() == wanted) return;
    throw Error(ErrorCode::Usage,
                fmt::format("{} given, there are {} {}", words.size(), wanted, things), name);
}

void draw(io::Canvas& canvas, const Image& image, const ToneMapping& mapping, int left, int top) {
    const std::vector<std::uint8_t> bytes = to_bytes(mapping, image);
    for (int y = 0; y < image.height; ++y) {
        for (int x = 0; x < image.width; ++x) {
            const std::uint8_t* byte =
                &bytes[3 * (static_cast<std::size_t>(y) * static_cast<std::size_t>(image.width) +
                            static_cast<std::size_t>(x))];
            canvas.set(left + x, top + y, {byte[0] / 255.0, byte[1] / 255.0, byte[2] / 255.0});
        }
    }
}

class SheetVerb {
  public:
    explicit SheetVerb(CLI::App& app) {
        files_ = add_text(app, "files", "PICTURE...", "pictures in linear light, .exr or .hdr", "")
                     ->expected(1, -1)
                     ->allow_extra_args()
                     ->multi_option_policy(CLI::MultiOptionPolicy::TakeAll);
        output_ = add_text(app, "-o,--output", "X.png", "the sheet", kOutput);
        columns_ = add_text(app, "--columns", "N", "pictures side by side", kOutput)
                       ->default_str("all in one row");
        title_ = add_text(app, "--title", "TEXT", "above all", kOutput);
        heads_ = add_text(app, "--heads", "A,B...", "above the columns", kOutput);
        labels_ = add_text(app, "--labels", "A,B...", "below the pictures", kOutput);
        tone_.add_to(app, {"tonemap", "exposure", "transfer"});
        app.add_flag("--quiet", quiet_, "do not name the file written")->group(kOutput);
        set_help(app, "sheet A.exr B.exr ... -o X.png", kSheetClosing);
    }

    int run() {
        tone_.read();
        const ToneMapping mapping = tone_mapping(tone_);
        if (files_->count() == 0) throw Error(ErrorCode::Usage, "sheet needs pictures");
        const bool piped = text_of(output_) == kStandardOutput;
        if (output_->count() == 0 || (!piped && ending(text_of(output_)) != "png"))
            throw Error(ErrorCode::Usage, "sheet needs -o with a name ending in .png");
        if (!piped) check_output_file(text_of(output_));
        const std::vector<std::string> names = files_->results();
        const int count = static_cast<int>(names.size());
        const int columns =
            columns_->count() == 0 ? count : parse_count("columns", text_of(columns_), 1, count);
        const auto heads = words_of(heads_), labels = words_of(labels_);
        check_count("heads", heads, static_cast<std::size_t>(columns), "columns");
        check_count("labels", labels, names.size(), "pictures");

        std::vector<Image> images;
        for (const std::string& name : names) {
            require_kind(name, FileKind::Picture);
            images.push_back(io::read_image(name));
            const Image &first = images.front(), &last = images.back();
            if (last.width != first.width || last.height != first.height) {
                throw Error(ErrorCode::InvalidInput,
                            fmt::format("is {} x {}, the first picture {} x {}", last.width,
                                        last.height, first.width, first.height),
                            name);
            }
        }
        const Layout layout{columns,
                            (count + columns - 1) / columns,
                            images.front().width,
                            images.front().height,
                            title_->count() > 0,
                            !heads.empty(),
                            !labels.empty()};
        write(layout, images, mapping, heads, labels);
        if (!piped) Talk(quiet_, false)("wrote " + text_of(output_) + "\n");
        return 0;
    }

  private:
    void write(const Layout& at, const std::vector<Image>& images, const ToneMapping& mapping,
               const std::vector<std::string>& heads,
               const std::vector<std::string>& labels) const {
        io::Canvas canvas(at.sheet_width(), at.sheet_height(), kPaper);
        const double letters = at.letters();
        const auto words = [&](const std::string& text, double x, double baseline, double size,
                               io::Colour colour) {
            draw_text(canvas, {x, baseline}, text, {size, colour}, io::Align::Centre);
        };
        if (at.title) {
            words(text_of(title_), 0.5 * canvas.width(), at.margin() + 1.1 * letters,
                  1.35 * letters, kInk);
        }
        for (std::size_t k = 0; k < heads.size(); ++k) {
            words(heads[k], at.left(static_cast<int>(k)) + 0.5 * at.width,
                  at.top(0) - 0.55 * letters, letters, kInk);
        }
        for (std::size_t k = 0; k < images.size(); ++k) {
            const int column = static_cast<int>(k) % at.columns;
            const int row = static_cast<int>(k) / at.columns;
            draw(canvas, images[k], mapping, at.left(column), at.top(row));
            if (labels.empty()) continue;
            words(labels[k], at.left(column) + 0.5 * at.width,
                  at.top(row) + at.height + 1.1 * letters, letters, kFaintInk);
        }
        if (text_of(output_) != kStandardOutput) return io::write_png(canvas, text_of(output_));
        const StandardOutputFile file("png");
        io::write_png(canvas, file.path());
        file.send();
    }

    RenderOptions tone_;
    CLI::Option *files_ = nullptr, *output_ = nullptr, *columns_ = nullptr, *title_ = nullptr,
                *heads_ = nullptr, *labels_ = nullptr;
    bool quiet_ = false;
};

}  // namespace

Verb add_sheet(CLI::App& program) {
    CLI::App* app = program.add_subcommand("sheet", "put rendered pictures side by side");
    const auto verb = std::make_shared<SheetVerb>(*app);
    return {app, [verb] { return verb->run(); }};
}

}  // namespace asperity::cli
