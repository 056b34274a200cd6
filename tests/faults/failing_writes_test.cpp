// SPDX-License-Identifier: Apache-2.0
//
// Every writer of the library, with each call to the operating system failing in turn: one error,
// the old file as it was, nothing left over. This program's write(), fsync(), rename() and lseek()
// stand in the way of the C library's.
#include <asperity/bsdf/spec.h>
#include <asperity/formats/bsdfs/bsdf_format.h>
#include <asperity/formats/heights/surface_files.h>
#include <asperity/formats/images/render_writer.h>
#include <asperity/formats/models/model_writer.h>
#include <asperity/formats/results/result_file.h>
#include <asperity/formats/test_files.h>
#include <asperity/gonio/test_measurements.h>
#include <asperity/pictures/pictures.h>
#include <asperity/plots/files/write_plot.h>
#include <fcntl.h>
#include <sys/syscall.h>
#include <unistd.h>

#include <atomic>
#include <cerrno>
#include <functional>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <vector>

namespace {

enum class Call { Write, Sync, Rename, Seek };
enum class Fault { Fails, Interrupted, Short };

/// Which of the calls of a kind goes wrong, and how; counted while `armed`.
struct Plan {
    std::atomic<bool> armed{false};
    Call call = Call::Write;
    Fault fault = Fault::Fails;
    int error = 0;
    long place = 0;  ///< from 1
    std::atomic<long> count{0};

    bool strikes(Call which) { return armed && which == call && ++count == place; }
};
Plan plan;

}  // namespace

extern "C" {
ssize_t write(int file, const void* bytes, size_t size) {
    if (plan.strikes(Call::Write)) {
        if (plan.fault == Fault::Short && size > 1)
            return syscall(SYS_write, file, bytes, size / 2);
        if (plan.fault != Fault::Short) {
            errno = plan.error;
            return -1;
        }
    }
    return syscall(SYS_write, file, bytes, size);
}
int fsync(int file) {
    if (!plan.strikes(Call::Sync)) return fcntl(file, F_GETFD) < 0 ? -1 : 0;  // no disk to wait for
    errno = plan.error;
    return -1;
}
int rename(const char* from, const char* to) noexcept {
    if (!plan.strikes(Call::Rename)) return static_cast<int>(syscall(SYS_rename, from, to));
    errno = plan.error;
    return -1;
}
off_t lseek(int file, off_t offset, int whence) noexcept {
    if (!plan.strikes(Call::Seek)) return syscall(SYS_lseek, file, offset, whence);
    errno = plan.error;
    return -1;
}
}

namespace asperity::io {
namespace {

struct Writer {
    std::string file;  ///< name of what it writes
    std::function<void(const std::string& path)> write;
};

TriangleMesh one_triangle() {
    TriangleMesh mesh;
    mesh.positions = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}};
    mesh.triangles = {{0, 1, 2}};
    return mesh;
}

/// All of them: formats of results from their list, the others one by one.
std::vector<Writer> writers() {
    const Heightfield surface = asperity::test::noise(24, 3);
    const auto measurement = std::make_shared<const Measurement>(
        asperity::test::measured(surface, asperity::test::small_experiment(), 1));
    Film film(24, 16);
    for (int y = 0; y < film.height(); ++y)
        for (int x = 0; x < film.width(); ++x) film.at(x, y).add({0.03 * x, 0.05 * y, 0.5});
    const TriangleMesh mesh = one_triangle();

    std::vector<Writer> list;
    for (const char* name : {"heights.gsf", "heights.exr", "heights.txt"})
        list.push_back({name, [=](const std::string& path) { write_heights(surface, path); }});
    list.push_back({"result.asperity",
                    [=](const std::string& path) { save_measurement(*measurement, path); }});
    list.push_back({"layer.png", [=](const std::string& path) {
                        write_layer_png(*measurement, measurement->layers[0], path, {});
                    }});
    list.push_back(
        {"sheet.png", [=](const std::string& path) { write_layer_sheet(*measurement, path, {}); }});
    list.push_back({"surface.png", [=](const std::string& path) {
                        write_surface_png(surface, path, SurfaceLook::Shaded);
                    }});
    for (const char* name : {"plot.svg", "plot.pdf", "plot.png", "plot.csv"})
        list.push_back({name, [](const std::string& path) {
                            asperity::plots::write_plot(asperity::plots::MessagePlot("nothing"), {},
                                                        path);
                        }});
    list.push_back({"picture.exr", [=](const std::string& path) {
                        write_render_exr(film, {{"model", "sphere"}}, path);
                    }});
    list.push_back({"picture.png", [=](const std::string& path) {
                        write_render_png(film, {}, {{"model", "sphere"}}, path);
                    }});
    list.push_back({"model.obj", [=](const std::string& path) { write_obj(mesh, path); }});
    list.push_back({"model.ply", [=](const std::string& path) { write_ply(mesh, path); }});
    const auto source = std::make_shared<const ExportSource>(measurement, 1);
    const auto model_source = [](const char* spec) {
        return std::make_shared<const ExportSource>(
            std::shared_ptr<const Bsdf>(parse_brdf_spec(spec)), asperity::test::small_experiment(),
            1);
    };
    // What counts is how often a file is written to: the largest ones hold what is quickly
    // computed, and the others are of the coarsest kind
    const auto quick = model_source("lambert:albedo=0.5");
    const std::map<std::string, std::shared_ptr<const ExportSource>> sources = {
        {"materialx", model_source("ggx:alpha=0.3")},  // has parameters of a model, and no table
        {"merl", quick},
        {"rgl", quick},
        {"klems", quick}};
    const std::map<std::string, std::string> options = {{"klems", "basis=quarter"},
                                                        {"tensortree", "levels=3"}};
    const BsdfFormats formats;
    for (const BsdfFormat& format : formats.rows()) {
        if (!format.write) continue;
        const auto own = sources.find(format.name);
        const auto& from = own == sources.end() ? source : own->second;
        const auto chosen = options.find(format.name);
        const std::string text = chosen == options.end() ? "" : chosen->second;
        list.push_back({format.name + "." + format.endings.at(0), [=](const std::string& path) {
                            format.write(*from, FormatOptions(format.options, text), path);
                        }});
    }
    return list;
}

/// What became of a write with one call gone wrong.
struct Outcome {
    bool struck;  ///< there was such a call
    std::optional<Error> error;
};
Outcome with_fault(Call call, Fault fault, int error, long place,
                   const std::function<void()>& work) {
    plan.call = call;
    plan.fault = fault;
    plan.error = error;
    plan.place = place;
    plan.count = 0;
    plan.armed = true;
    auto thrown = test::error_of(work);
    plan.armed = false;
    return {plan.count >= place, std::move(thrown)};
}

/// Places worth a try: all of few calls, the first and last and some between of many.
long next_place(long place) {
    return place < 4 ? place + 1 : 2 * place;
}

class EveryWriter : public testing::Test {
  protected:
    void SetUp() override {
        for (const Writer& writer : all_) writer.write(folder_ / writer.file);
    }
    const std::vector<Writer> all_ = writers();
    const test::TemporaryFolder folder_;
};

TEST_F(EveryWriter, AFailedCallIsAnErrorAndTheOldFileStays) {
    const struct {
        Call call;
        int error;
    } kinds[] = {{Call::Write, ENOSPC}, {Call::Sync, EIO}, {Call::Rename, EIO}, {Call::Seek, EIO}};
    const long files = folder_.files();
    for (const Writer& writer : all_) {
        SCOPED_TRACE(writer.file);
        const std::string path = folder_ / writer.file;
        for (const auto& kind : kinds) {
            // Known beforehand how often it is called, the last call is tried, too
            with_fault(kind.call, Fault::Fails, kind.error, 1L << 40, [&] { writer.write(path); });
            const long calls = plan.count;
            EXPECT_GE(calls, kind.call == Call::Seek ? 0 : 1);
            test::put(path, "old");
            for (long place = 1; place <= calls;
                 place = place == calls ? calls + 1 : std::min(next_place(place), calls)) {
                const Outcome outcome = with_fault(kind.call, Fault::Fails, kind.error, place,
                                                   [&] { writer.write(path); });
                ASSERT_TRUE(outcome.struck);
                ASSERT_TRUE(outcome.error) << "call " << place << " of " << calls << " was lost";
                EXPECT_EQ(outcome.error->code(), ErrorCode::InputOutput);
                // The folder is synced when the new file is in place already
                const bool in_place = kind.call == Call::Sync && place == calls && calls > 1;
                if (in_place)
                    test::put(path, "old");
                else
                    EXPECT_EQ(test::get(path), "old") << "call " << place;
            }
            EXPECT_EQ(folder_.files(), files);
        }
    }
}

TEST_F(EveryWriter, ShortAndInterruptedWritesLoseNothing) {
    for (const Writer& writer : all_) {
        SCOPED_TRACE(writer.file);
        const std::string path = folder_ / writer.file, wanted = test::get(path);
        for (const Fault fault : {Fault::Short, Fault::Interrupted})
            for (const long place : {1, 2}) {
                const Outcome outcome =
                    with_fault(Call::Write, fault, EINTR, place, [&] { writer.write(path); });
                EXPECT_FALSE(outcome.error);
                EXPECT_EQ(test::get(path).size(), wanted.size());
            }
    }
}

TEST_F(EveryWriter, ADiskThatIsFullAtAnySizeIsTold) {
    for (const Writer& writer : all_) {
        SCOPED_TRACE(writer.file);
        const std::string path = folder_ / writer.file;
        const auto size = std::filesystem::file_size(path);
        test::put(path, "old");
        for (const std::uintmax_t room : {std::uintmax_t{0}, size / 3, size - 1}) {
            const auto error = [&] {
                const test::FileSizeLimit limit(room);
                return test::error_of([&] { writer.write(path); });
            }();
            ASSERT_TRUE(error) << room << " of " << size << " bytes";
            EXPECT_EQ(error->code(), ErrorCode::InputOutput);
            EXPECT_EQ(test::get(path), "old");
        }
    }
}

}  // namespace
}  // namespace asperity::io
