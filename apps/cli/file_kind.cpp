// SPDX-License-Identifier: Apache-2.0
#include "file_kind.h"

#include <asperity/core/error.h>
#include <asperity/formats/bsdfs/bsdf_format.h>
#include <asperity/formats/heights/heights_format.h>
#include <asperity/formats/images/image_format.h>
#include <asperity/formats/models/model_format.h>
#include <asperity/formats/read_file.h>
#include <asperity/formats/results/result_file.h>
#include <asperity/params/suggest.h>

#include <fmt/format.h>

#include <filesystem>
#include <vector>

namespace asperity::cli {

namespace fs = std::filesystem;

namespace {

struct Content {
    FileKind kind = FileKind::Unknown;
    std::string words = {};  ///< a sentence about "it"
};

/// A format decides by its content alone: endings are what beginners mix up.
Content content_of(const std::string& path) {
    const io::FileStart start = io::read_start(path);
    const io::BsdfFormats bsdfs;
    for (const io::BsdfFormat& row : bsdfs.rows())
        if (row.recognises && row.recognises(start.bytes))
            return {FileKind::Bsdf, fmt::format("it holds a BSDF ({})", row.name)};
    if (io::looks_like_result(path)) return {FileKind::Result, "it is a result of a measurement"};
    for (const io::ImageFormat& row : io::image_formats())
        if (row.sniff(start))
            return {FileKind::Picture, fmt::format("it is a picture ({})", row.name)};
    if (start.bytes.starts_with("\x89PNG"))
        return {FileKind::Screen, "it is a picture for screens (PNG)"};
    const io::HeightsFormats heights;
    for (const io::HeightsFormat& row : heights.rows())
        if (row.recognises && row.recognises(start.bytes))
            return {FileKind::Heights, fmt::format("it is a heightfield ({})", row.name)};
    for (const io::ModelFormat& row : io::model_formats())
        if (row.sniff(start))
            return {FileKind::Model, fmt::format("it is a 3D model ({})", row.name)};
    return {};
}

std::string name_of(FileKind kind) {
    switch (kind) {
        case FileKind::Result:
            return "a result of asperity simulate";
        case FileKind::Heights:
            return "a heightfield";
        case FileKind::Bsdf:
            return "a BSDF";
        case FileKind::Picture:
            return "a picture in linear light (.exr or .hdr)";
        case FileKind::Screen:
            return "a picture for screens";
        case FileKind::Model:
            return "a 3D model";
        case FileKind::Unknown:
            break;
    }
    return "known";
}

/// Where a file of this kind belongs.
std::string cure(FileKind found, const std::string& path) {
    switch (found) {
        case FileKind::Result:
            return fmt::format("asperity info {} shows it, --brdf of asperity render takes it",
                               path);
        case FileKind::Heights:
            return fmt::format("asperity simulate --surface {} measures it", path);
        case FileKind::Bsdf:
            return "asperity compare, fit, export and render --brdf take it";
        case FileKind::Picture:
            return "asperity compare takes two, asperity render --light env:FILE a map";
        case FileKind::Screen:
            return "asperity render -o X.exr keeps the light itself";
        case FileKind::Model:
            return fmt::format("asperity render --model {} shows it", path);
        case FileKind::Unknown:
            break;
    }
    return {};
}

/// Heights may be kept as pictures, and a BSDF in a text table.
bool may_be(FileKind wanted, FileKind found) {
    if (found == FileKind::Unknown || found == wanted) return true;
    return wanted == FileKind::Heights && (found == FileKind::Picture || found == FileKind::Screen);
}

}  // namespace

std::string did_you_mean_file(const std::string& path) {
    const fs::path asked = path;
    const fs::path folder = asked.parent_path().empty() ? fs::path(".") : asked.parent_path();
    std::vector<std::string> names;
    std::error_code ignored;
    for (const fs::directory_entry& entry : fs::directory_iterator(folder, ignored))
        names.push_back(entry.path().filename().string());
    const std::string meant = nearest(asked.filename().string(), names);
    if (meant.empty()) return {};
    return "; did you mean " + (asked.parent_path() / meant).string() + "?";
}

void require_kind(const std::string& path, FileKind wanted) {
    std::error_code ignored;
    if (!path.empty() && !fs::exists(path, ignored))
        throw Error(ErrorCode::InputOutput, "there is no such file" + did_you_mean_file(path),
                    path);
    if (!fs::is_regular_file(path, ignored)) return;
    const Content content = content_of(path);
    if (may_be(wanted, content.kind)) return;
    throw Error(
        ErrorCode::InvalidInput,
        fmt::format("{}, not {}: {}", content.words, name_of(wanted), cure(content.kind, path)),
        path);
}

void refuse_known_kind(const std::string& path, const std::string& wanted,
                       const std::string& cure) {
    std::error_code ignored;
    if (!fs::is_regular_file(path, ignored)) return;
    const Content content = content_of(path);
    if (content.kind == FileKind::Unknown) return;
    throw Error(ErrorCode::InvalidInput, fmt::format("{}, not {}: {}", content.words, wanted, cure),
                path);
}

Measurement load_result(const std::string& path) {
    require_kind(path, FileKind::Result);
    return io::load_measurement(path);
}

io::ResultHead load_result_head(const std::string& path) {
    require_kind(path, FileKind::Result);
    return io::load_head(path);
}

io::ResultHead load_result_lobes(const std::string& path) {
    require_kind(path, FileKind::Result);
    return io::load_lobes(path);
}

}  // namespace asperity::cli
