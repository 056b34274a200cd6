// SPDX-License-Identifier: Apache-2.0
// The thesis' checks of "Load model from file": a small and a large model, read from files.
#include "run_check.h"

#include <asperity/core/error.h>
#include <asperity/formats/models/model_reader.h>
#include <asperity/formats/models/model_writer.h>
#include <asperity/render/builtin_models.h>

#include <fmt/format.h>
#include <stdlib.h>

#include <cstdint>
#include <filesystem>
#include <system_error>
#include <vector>

namespace asperity::checks {

namespace {

/// A folder that lives as long as the object.
class TemporaryFolder {
  public:
    TemporaryFolder() {
        std::error_code error;
        std::string name =
            (std::filesystem::temp_directory_path(error) / "asperity-XXXXXX").string();
        if (error || ::mkdtemp(name.data()) == nullptr)
            throw Error(ErrorCode::InputOutput, "cannot make a temporary folder", name);
        path_ = name;
    }
    ~TemporaryFolder() {
        std::error_code ignored;
        std::filesystem::remove_all(path_, ignored);
    }
    TemporaryFolder(const TemporaryFolder&) = delete;
    TemporaryFolder& operator=(const TemporaryFolder&) = delete;

    std::string operator/(const std::string& name) const { return (path_ / name).string(); }

  private:
    std::filesystem::path path_;
};

/// A built-in model and its counts, known from how it is made: a square is two triangles; the knot
/// a net of 96 x 960 squares whose first and last rows and columns lie at the same places.
struct KnownModel {
    const char* name;
    const char* size;
    std::uint64_t triangles, vertices;
};

constexpr KnownModel kSmall{"plane", "small", 2, 4};
constexpr KnownModel kLarge{"knot", "large", 2 * 96 * 960, 97 * 961};

/// The model written as OBJ and as PLY, and what is read back.
std::vector<ModelStatistics> read_back(const char* name) {
    const TemporaryFolder folder;
    const TriangleMesh mesh = make_builtin_model(name).meshes.at(0);
    const std::string obj = folder / "model.obj", ply = folder / "model.ply";
    io::write_obj(mesh, obj);
    io::write_ply(mesh, ply);
    return {statistics(io::read_model(obj).model), statistics(io::read_model(ply).model)};
}

void check_model(const Run& run, const KnownModel& model, const CheckReport& report) {
    const auto check_count = [&](const char* what, std::uint64_t wanted,
                                 std::uint64_t ModelStatistics::*count) {
        const std::string name = fmt::format("Model loading, {} ({}): {} {} as OBJ and as PLY",
                                             model.size, model.name, wanted, what);
        run_check(run, report, name, [&]() -> std::string {
            for (const ModelStatistics& s : read_back(model.name)) {
                if (s.*count != wanted) return fmt::format("{} were read", s.*count);
            }
            return {};
        });
    };
    check_count("triangles", model.triangles, &ModelStatistics::unique_triangles);
    check_count("vertices", model.vertices, &ModelStatistics::unique_vertices);
}

}  // namespace

void check_models(Run& run, const CheckReport& report) {
    check_model(run, kSmall, report);
    check_model(run, kLarge, report);
}

}  // namespace asperity::checks
