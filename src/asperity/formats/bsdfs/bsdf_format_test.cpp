// SPDX-License-Identifier: Apache-2.0
#include <asperity/bsdf/spec.h>
#include <asperity/formats/atomic_file.h>
#include <asperity/formats/bsdfs/bsdf_format.h>
#include <asperity/formats/test_files.h>
#include <asperity/gonio/test_layers.h>

#include <fmt/format.h>

#include <algorithm>
#include <atomic>
#include <filesystem>
#include <set>
#include <thread>

namespace asperity::io {
namespace {

using namespace asperity::test;

std::shared_ptr<const Measurement> one_layer() {
    Measurement m = empty_measurement(DetectorKind::LatLong, 8, {"all"}, {0, 30});
    add_rays(m, m.layers[1], 0, 0, 11, 250);
    return std::make_shared<const Measurement>(std::move(m));
}

TEST(BsdfFormats, NamesAreUniqueAndEveryRowSaysWhatItIs) {
    std::set<std::string> names;
    const BsdfFormats formats;
    for (const BsdfFormat& format : formats.rows()) {
        EXPECT_TRUE(names.insert(format.name).second) << format.name;
        EXPECT_FALSE(format.endings.empty()) << format.name;
        EXPECT_FALSE(format.doc.empty()) << format.name;
        EXPECT_TRUE(format.write || format.read) << format.name;
        for (const FormatOption& option : format.options) EXPECT_FALSE(option.doc.empty());
    }
}

TEST(BsdfFormats, AStopEndsEveryWriterAndLeavesNoFile) {
    const io::test::TemporaryFolder folder;
    const BsdfFormats formats;
    for (const BsdfFormat& format : formats.rows()) {
        if (!format.write) continue;
        asperity::Run run(2);
        const bool layers = format.name.starts_with("layers");
        ExportSource source = layers ? ExportSource(one_layer(), 2)
                                     : ExportSource(parse_brdf_spec("ggx:alpha=0.3"), {}, 2);
        source.watch(run);
        run.request_stop();
        const std::string path = folder / ("stopped." + format.endings.front());
        try {
            format.write(source, FormatOptions(format.options, ""), path);
            ADD_FAILURE() << format.name;
        } catch (const Error& error) {
            EXPECT_EQ(error.code(), ErrorCode::Stopped) << format.name << error.what();
        }
        EXPECT_EQ(folder.files(), 0) << format.name;
    }
}

/// Counts what is asked of it, and asks the run to stop at the last question: what is left to do is
/// to write numbers down.
class StopsAtTheEnd final : public Bsdf {
  public:
    int channels() const override { return model_->channels(); }
    std::string name() const override { return "stops at the end"; }
    bool isotropic() const override { return true; }
    void eval(Vec3 wi, Vec3 wo, std::span<double> f) const override {
        if (++asked == last && run) run->request_stop();
        model_->eval(wi, wo, f);
    }
    std::optional<BsdfSample> sample(Vec3 wi, double u1, double u2) const override {
        return model_->sample(wi, u1, u2);
    }
    double pdf(Vec3 wi, Vec3 wo) const override { return model_->pdf(wi, wo); }

    mutable std::atomic<std::uint64_t> asked = 0;
    std::uint64_t last = 0;
    asperity::Run* run = nullptr;

  private:
    std::unique_ptr<Bsdf> model_ = parse_brdf_spec("ggx:alpha=0.3");
};

TEST(BsdfFormats, AStopIsHeardWhileNumbersAreWritten) {
    const io::test::TemporaryFolder folder;
    const BsdfFormats formats;
    for (const BsdfFormat& format : formats.rows()) {
        if (!format.write || format.name.starts_with("layers") || format.name == "materialx")
            continue;
        const std::string options = format.name == "klems"        ? "basis=quarter"
                                    : format.name == "tensortree" ? "levels=4"
                                                                  : "";
        const auto write = [&](StopsAtTheEnd* model) {
            const std::shared_ptr<const Bsdf> bsdf(model);
            asperity::Run run(2);
            model->run = &run;
            ExportSource source(bsdf, {}, 2);
            source.watch(run);
            format.write(source, FormatOptions(format.options, options), folder / "f.x");
            return std::uint64_t{model->asked};
        };
        const std::uint64_t all = write(new StopsAtTheEnd);
        EXPECT_EQ(folder.files(), 1) << format.name;
        std::filesystem::remove(folder / "f.x");
        auto stopping = std::make_unique<StopsAtTheEnd>();
        stopping->last = all;
        try {
            write(stopping.release());
            ADD_FAILURE() << format.name;
        } catch (const Error& error) {
            EXPECT_EQ(error.code(), ErrorCode::Stopped) << format.name << error.what();
        }
        EXPECT_EQ(folder.files(), 0) << format.name;
    }
}

TEST(BsdfFormats, AStopIsHeardWhileLayersAreWritten) {
    const io::test::TemporaryFolder folder;
    const BsdfFormats formats;
    auto m = std::make_shared<Measurement>(
        empty_measurement(DetectorKind::LatLong, 256, {"R", "G", "B"}, {0, 20, 40, 60, 80}));
    for (Layer& layer : m->layers)
        for (int k = 0; k < 5000; ++k) add_rays(*m, layer, 0, k % 3, k, 7 + k % 11);
    for (const char* name : {"layers", "layers-csv"}) {
        asperity::Run run(2);
        ExportSource source(m, 2);
        source.watch(run);
        // Once its file is there, it is being written
        std::thread watcher([&] {
            while (folder.files() == 0) std::this_thread::yield();
            run.request_stop();
        });
        try {
            formats.find(name)->write(source, FormatOptions({}, ""), folder / "f.x");
            ADD_FAILURE() << name;
        } catch (const Error& error) {
            EXPECT_EQ(error.code(), ErrorCode::Stopped) << name << error.what();
        }
        watcher.join();
        EXPECT_EQ(folder.files(), 0) << name;
    }
}

TEST(BsdfFormats, AreChosenByNameElseByEnding) {
    const BsdfFormats formats;
    EXPECT_EQ(formats.for_writing("a.EXR", "").name, "layers");
    EXPECT_EQ(formats.for_writing("a.txt", "layers-csv").name, "layers-csv");
    EXPECT_THROW(formats.for_writing("a.jpg", ""), Error);
    EXPECT_THROW(formats.for_writing("a.exr", "nothing"), Error);
}

TEST(BsdfFormats, AProgramAddsItsOwn) {
    BsdfFormats formats;
    const auto write = [](const ExportSource& source, const FormatOptions& options,
                          const std::string& path) -> BsdfFormat::Remarks {
        AtomicFile file(path);
        file.write(std::to_string(source.thetas().size() *
                                  static_cast<std::size_t>(options.count("times", 1, 9, 1))));
        file.commit();
        return {"only the number of layers"};
    };
    formats.add({"count", {"exr"}, "how many layers", {{"times", "2", "factor"}}, write, {}, {}});
    EXPECT_THROW(formats.add({"count", {"x"}, "again", {}, write, {}, {}}), Error);

    const test::TemporaryFolder folder;
    const ExportSource source(one_layer(), 1);
    const BsdfFormat& format = formats.for_writing("x.exr", "");
    ASSERT_EQ(format.name, "count");
    format.write(source, FormatOptions(format.options, "times=3"), folder / "x.exr");
    EXPECT_EQ(test::get(folder / "x.exr"), "6");
    format.write(source, FormatOptions(format.options, ""), folder / "x.exr");
    EXPECT_EQ(test::get(folder / "x.exr"), "4");
}

TEST(FormatOptions, RefuseWhatTheyDoNotKnow) {
    const std::vector<FormatOption> known = {{"n", "", "grid"}, {"basis", "full", "patches"}};
    EXPECT_THROW(FormatOptions(known, "m=3"), Error);
    EXPECT_THROW(FormatOptions(known, "n"), Error);
    EXPECT_THROW(FormatOptions(known, "n=3,n=4"), Error);
    EXPECT_THROW(FormatOptions({}, "n=3"), Error);
    const FormatOptions options(known, " n=12, basis=half");
    EXPECT_EQ(options.count("n", 2, 64, 32), 12);
    EXPECT_THROW(options.count("n", 16, 64, 32), Error);
    EXPECT_THROW(options.word("basis", {"full", "quarter"}), Error);
    EXPECT_EQ(FormatOptions(known, "").count("n", 2, 64, 32), 32);
}

TEST(LayersCsv, HasALineACell) {
    const test::TemporaryFolder folder;
    const auto m = one_layer();
    const ExportSource source(m, 1);
    const BsdfFormats formats;
    formats.find("layers-csv")->write(source, FormatOptions({}, ""), folder / "a.csv");
    const std::string text = test::get(folder / "a.csv");
    EXPECT_EQ(
        std::count(text.begin(), text.end(), '\n') - std::count(text.begin(), text.end(), '#'),
        1 + 2 * 32);
    // Cell 11 is row 1 of 4, column 3 of 8: a quarter of the energy over its projected solid angle.
    const double area = m->detector.projected_solid_angle(1);
    EXPECT_NE(
        text.find(fmt::format("\n2,30,0,33.75,157.5,{:.6g},{:.7g},0,250\n", area, 0.25 / area)),
        std::string::npos);
    EXPECT_NE(text.find("# checksum "), std::string::npos);
}

TEST(IsotropicMean, LeavesWhatIsIsotropicAndMirrorSymmetricAlone) {
    const std::shared_ptr<const Bsdf> ggx = parse_brdf_spec("ggx:alpha=0.3");
    const auto mean = isotropic_mean(ggx, 4);
    const Vec3 wi = from_spherical(0.7, 2), wo = from_spherical(0.5, -0.4);
    double a = 0, b = 0;
    ggx->eval(wi, wo, {&a, 1});
    mean->eval(wi, wo, {&b, 1});
    EXPECT_NEAR(b, a, 1e-12 * a);
}

TEST(IsotropicMean, IsTheMeanOverAzimuthsAndSides) {
    // Not mirror-symmetric: a brushed metal lit off its axes.
    const std::shared_ptr<const Bsdf> brushed = parse_brdf_spec("ggx:alpha=0.2,alpha_y=0.6");
    const auto mean = isotropic_mean(brushed, 2);
    const double theta_i = 0.7, theta_o = 0.5, phi = 2.5;
    double expected = 0;
    for (const double turn : {0.0, kPi})
        for (const double side : {phi, -phi}) {
            double f = 0;
            brushed->eval(from_spherical(theta_i, turn), from_spherical(theta_o, turn + side),
                          {&f, 1});
            expected += f / 4;
        }
    double f = 0;
    mean->eval(from_spherical(theta_i, 1.1), from_spherical(theta_o, 1.1 + phi), {&f, 1});
    EXPECT_NEAR(f, expected, 1e-12 * expected);
}

}  // namespace
}  // namespace asperity::io
