// SPDX-License-Identifier: Apache-2.0
#include <asperity/formats/results/result_file.h>

#include <asperity/core/error.h>
#include <asperity/core/parallel.h>
#include <asperity/core/run.h>
#include <asperity/formats/results/field_reader.h>
#include <asperity/formats/results/result_fields.h>
#include <asperity/formats/results/spared_fields.h>
#include <asperity/gonio/experiment_text.h>
#include <asperity/gonio/measurement_check.h>
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <new>

namespace asperity::io {
namespace {

// Turns the fields of an open container back into a Measurement.
class ResultReader : FieldReader {
  public:
    using FieldReader::FieldReader;

    Measurement read() {
        check_format();
        check_stored();
        read_settings();
        read_layers();
        read_cells();
        read_spreads();
        std::string why;
        parallel_for(2, Run().threads(), [&](std::size_t check) {
            if (check == 0)
                check_whole();
            else
                why = contradiction(result_);
        });
        if (!why.empty())
            file_.fail(first_of({"energy", "energy_of_paths", "energy_rest"}).offset, why);
        return std::move(result_);
    }

    ResultHead read_head() {
        if (check_format() < 3 || file_.find("energy_halves") != nullptr) {
            Measurement whole = read();
            return {std::move(whole), text("checksum")};
        }
        check_stored();
        read_settings();
        read_layers();
        if (file_.find("cell_noise") != nullptr) read_noise();
        return {std::move(result_), text("checksum")};
    }

    ResultHead read_lobes() {
        without_groups_ = file_.find("group_energy_rest") != nullptr;
        Measurement lobes = read();
        return {std::move(lobes), text("checksum")};
    }

  private:
    std::uint32_t check_format() const {
        const TensorField* field = file_.find("format");
        if (field == nullptr) file_.fail(0, "a tensor file, but no result of Asperity");
        const auto format = values<std::uint32_t>("format", TensorType::U32, {1}).front();
        if (format == 0 || format > static_cast<std::uint32_t>(kResultFormat))
            file_.fail(field->offset, fmt::format("format {} is not known here, at most {} is",
                                                  format, kResultFormat));
        return format;
    }

    // Every byte is covered: the checksums cover the fields, the layout leaves none between them.
    // The two last fields changed places with format 3: before that, "checksum" is not covered.
    void check_stored() {
        file_.require_own_layout();
        const auto& fields = file_.fields();
        const std::size_t table = fields.size() - (check_format() < 3 ? 2 : 1);
        if (fields.size() < 3 || fields[table].name != "field_checksums" ||
            file_.find("checksum") == nullptr)
            file_.fail(0, "the checksums are missing");
        const auto stored = values<std::uint64_t>("field_checksums", TensorType::U64, {table, 2});
        for (std::size_t k = 0; k < table; ++k) {
            digests_.push_back(stored_digest_of(file_, fields[k]));
            if (digests_[k] != Digest{stored[2 * k], stored[2 * k + 1]})
                file_.fail(
                    fields[k].offset,
                    fmt::format("field '{}' is damaged: its {} bytes do not fit its checksum",
                                fields[k].name, fields[k].bytes));
        }
    }

    // What is left out counts as if it were there.
    void check_whole() const {
        std::vector<Digest> counted;
        for (std::size_t k = 0; k < digests_.size(); ++k) {
            const TensorField& field = file_.fields()[k];
            if (!in_checksum(field.name)) continue;
            if (field.name == "stderr_albedo" && file_.find("stderr_energy") == nullptr)
                counted.push_back(digest_of(
                    layer_block("stderr_energy", TensorType::F32, {}, &Layer::stderr_energy)));
            if (field.name == "format")
                counted.push_back(format_digest());
            else if (field.name == "energy" || field.name == "energy_of_paths" ||
                     field.name == kEnergyRest)
                counted.push_back(digest_of(layer_block(
                    "energy", TensorType::U64, {extent(result_.orders())}, &Layer::energy)));
            else
                counted.push_back(field.packed ? digest_of(file_, field) : digests_[k]);
        }
        if (text("checksum") != checksum_of(counted))
            file_.fail(file_.find("checksum")->offset, "the checksum of the whole does not fit");
    }

    // An array over cells as ResultFields has it, `axes` behind that of the layers.
    template <typename T>
    TensorBlock layer_block(const char* name, TensorType type, const Shape& axes,
                            std::vector<T> Layer::*member) const {
        TensorBlock block = {name, type, {result_.layers.size()}, {}};
        block.shape.insert(block.shape.end(), axes.begin(), axes.end());
        for (const int count :
             {result_.channels(), result_.detector.rows(), result_.detector.columns()})
            block.shape.push_back(extent(count));
        for (const Layer& layer : result_.layers)
            block.parts.push_back(std::as_bytes(std::span(layer.*member)));
        return block;
    }

    void read_settings() {
        try_reading("experiment", [&](const std::string& text) {
            result_.experiment = experiment_from_text(text, "line");
            validate(result_.experiment);
        });
        try_reading("channel_names",
                    [&](const std::string& text) { read_channel_names_json(text, result_); });
        try_reading("surface", [&](const std::string& text) { read_surface_json(text, result_); });
        try_reading("provenance",
                    [&](const std::string& text) { read_provenance_json(text, result_); });
        result_.detector = Detector(result_.experiment.detector);
        const auto edges =
            values<double>("theta_edges", TensorType::F64, {extent(result_.detector.rows()) + 1});
        for (std::size_t row = 0; row < edges.size(); ++row)
            if (!(std::abs(edges[row] - result_.detector.theta_edge(static_cast<int>(row))) <=
                  1e-12))
                file_.fail(file_.find("theta_edges")->offset,
                           "field 'theta_edges' does not fit the detector of the experiment");
    }

    void read_layers() {
        const std::uint64_t count = file_.require("theta_i", TensorType::F64, 1).shape.front();
        result_.layers.resize(static_cast<std::size_t>(count));
        read_scalars("layer_number", TensorType::I32, &Layer::number);
        read_scalars("theta_i", TensorType::F64, &Layer::theta_i);
        read_scalars("phi_i", TensorType::F64, &Layer::phi_i);
        read_scalars("rays", TensorType::U64, &Layer::rays);
        read_scalars("segments", TensorType::U64, &Layer::segments);
        read_scalars("reflections", TensorType::U64, &Layer::reflections);
        read_scalars("stuck", TensorType::U64, &Layer::stuck);
        read_scalars("batches", TensorType::I32, &Layer::batches);

        const std::uint64_t channels = extent(result_.channels());
        const std::uint64_t bounces = extent(result_.bounces());
        read_arrays("escaped", TensorType::U64, {count, channels}, &Layer::escaped);
        read_arrays("absorbed", TensorType::U64, {count, channels}, &Layer::absorbed);
        read_arrays("truncated", TensorType::U64, {count, channels}, &Layer::truncated);
        read_arrays("edge", TensorType::U64, {count, channels}, &Layer::edge);
        read_arrays("escaped_by_bounce", TensorType::U64, {count, channels, bounces},
                    &Layer::escaped_by_bounce);
        read_arrays("stderr_albedo", TensorType::F64, {count, channels}, &Layer::stderr_albedo);
        read_arrays("stderr_albedo_by_bounce", TensorType::F64, {count, channels, bounces},
                    &Layer::stderr_albedo_by_bounce);
    }

    Shape cells() const {
        return {result_.layers.size(), extent(result_.channels()), extent(result_.detector.rows()),
                extent(result_.detector.columns())};
    }

    void read_cells() {
        const Shape c = cells();
        if (file_.find(kEnergyRest) == nullptr)
            read_arrays(file_.find("energy_of_paths") ? "energy_of_paths" : "energy",
                        TensorType::U64, {c[0], extent(result_.orders()), c[1], c[2], c[3]},
                        &Layer::energy);
        if (file_.find("stderr_energy") != nullptr || file_.find("energy_squares_rest") == nullptr)
            read_arrays("stderr_energy", TensorType::F32, c, &Layer::stderr_energy);
    }

    void read_spreads() {
        for (const char* axis : {"sides", "elements"})
            if (const TensorField* found = file_.find(axis);
                found && values<std::uint32_t>(axis, TensorType::U32, {1}).front() != 1)
                file_.fail(found->offset, fmt::format("more {} than one are not known here", axis));
        const bool spared = file_.find("energy_squares_rest") != nullptr;
        if (!spared && file_.find("energy_squares") == nullptr) return;
        const std::uint64_t count = result_.layers.size(), channels = extent(result_.channels());
        const Shape cells = this->cells();
        if (!spared)
            read_parts(
                "energy_squares", TensorType::U64, {cells[0], cells[1], cells[2], cells[3], 2},
                [](Layer & layer) -> auto& { return layer.spread.squares; });
        if (file_.find("energy_stretched") != nullptr)
            read_parts(
                "energy_stretched", TensorType::U64, cells,
                [](Layer & layer) -> auto& { return layer.spread.stretched; });
        const auto largest = values<std::uint64_t>("largest_batch", TensorType::U64, {count});
        for (std::size_t k = 0; k < largest.size(); ++k)
            result_.layers[k].spread.largest_batch = largest[k];
        read_done();
        read_wide("escaped_by_bounce_spread", {count, channels, extent(result_.bounces()), 3},
                  &LayerSpread::bounces);
        read_wide("escaped_spread", {count, channels, 3}, &LayerSpread::albedo);
        if (spared || file_.find("batches_reached") != nullptr) read_groups(cells);
        read_halves(cells);
        if (spared) read_spared();
    }

    // What is left out, last of all: it follows from the rest.
    void read_spared() {
        const SumShape shape = result_.shape();
        std::vector<SparedLayer> spared =
            read_spared_layers(file_, result_.layers.size(), shape, !without_groups_);
        const bool errors_follow = file_.find("stderr_energy") == nullptr;
        parallel_for(spared.size(), Run().threads(), [&](std::size_t k) {
            spared[k].errors_follow = errors_follow;
            restore(result_.layers[k], spared[k], shape);
            spared[k] = {};
            if (without_groups_) forget_groups(result_.layers[k].spread);
        });
    }

    static void forget_groups(LayerSpread& spread) {
        spread.reached.clear();
        spread.albedo_by_age.clear();
        spread.groups = {};
    }

    void read_halves(const Shape& cells) {
        const bool whole = file_.find("energy_halves") != nullptr;
        if (!whole && file_.find("energy_halves_rest") == nullptr) return;
        if (whole)
            read_parts(
                "energy_halves", TensorType::U64, {cells[0], cells[1], cells[2], cells[3], 2},
                [](Layer & layer) -> auto& { return layer.spread.halves.cells; });
        read_halves_of_albedo();
    }

    void read_halves_of_albedo() {
        read_parts(
            "escaped_halves", TensorType::U64,
            {result_.layers.size(), extent(result_.channels()), 2},
            [](Layer & layer) -> auto& { return layer.spread.halves.albedo; });
    }

    // What of the errors is the rays', without the cells.
    void read_noise() {
        read_halves_of_albedo();
        const auto noise =
            values<double>("cell_noise", TensorType::F64, {result_.layers.size(), 2});
        for (std::size_t k = 0; k < result_.layers.size(); ++k)
            result_.layers[k].spread.cell_noise = CellNoise{noise[2 * k], noise[2 * k + 1]};
    }

    void read_groups(const Shape& cells) {
        read_wide("escaped_spread_by_age", {cells[0], LayerSums::kAges, cells[1], 3},
                  &LayerSpread::albedo_by_age);
        if (file_.find("energy_of_rays") != nullptr) {
            read_parts(
                "energy_of_rays", TensorType::U64, cells,
                [](Layer & layer) -> auto& { return layer.spread.exact; });
            for (Layer& layer : result_.layers) {
                std::vector<std::uint64_t>& exact = layer.spread.exact;
                const auto all = energy_of_all_orders(layer, exact.size());
                for (std::size_t k = 0; k < exact.size(); ++k) {
                    if (exact[k] > all[k])
                        file_.fail(file_.find("energy_of_rays")->offset,
                                   "field 'energy_of_rays' is more than all of the energy");
                    exact[k] = all[k] - exact[k];
                }
            }
        }
        read_parts(
            "batches_reached", TensorType::U32, cells,
            [](Layer & layer) -> auto& { return layer.spread.reached; });
        const CoarseGrid grid(result_.shape());
        read_parts(
            "group_rays", TensorType::U64, {cells[0], GroupSums::kGroups},
            [](Layer & layer) -> auto& { return layer.spread.groups.rays; });
        if (file_.find("group_energy_rest") != nullptr) return;
        read_parts(
            "group_energy", TensorType::U64,
            {cells[0], GroupSums::kGroups, grid.down, grid.across, cells[1]},
            [](Layer & layer) -> auto& { return layer.spread.groups.energy; });
    }

    void read_done() {
        const TensorField& found = file_.require("batches_done", TensorType::U64, 2);
        const auto rows =
            values<std::uint64_t>("batches_done", TensorType::U64, {found.shape[0], 3});
        for (std::size_t k = 0; k < rows.size(); k += 3)
            if (rows[k] >= result_.layers.size() ||
                !result_.layers[rows[k]].spread.done.add({rows[k + 1], rows[k + 2]}))
                file_.fail(found.offset, "field 'batches_done' contradicts itself");
    }

    void read_wide(const char* name, const Shape& shape,
                   std::vector<LayerSums::Spread> LayerSpread::*member) {
        const auto words = values<std::uint64_t>(name, TensorType::U64, shape);
        const std::size_t each = words.size() / std::max<std::size_t>(result_.layers.size(), 1);
        for (std::size_t k = 0; k < words.size(); k += 3)
            (result_.layers[k / each].spread.*member)
                .push_back({words[k], (LayerSums::Wide{words[k + 2]} << 64) | words[k + 1]});
    }

    template <typename T>
    void read_scalars(const char* name, TensorType type, T Layer::*member) {
        const auto numbers = values<T>(name, type, {result_.layers.size()});
        for (std::size_t k = 0; k < numbers.size(); ++k) result_.layers[k].*member = numbers[k];
    }

    // Each layer's share goes straight to its place.
    template <typename T>
    void read_arrays(const char* name, TensorType type, const Shape& shape,
                     std::vector<T> Layer::*member) {
        read_parts(
            name, type, shape, [&](Layer & layer) -> auto& { return layer.*member; });
    }

    template <typename Part>
    void read_parts(const char* name, TensorType type, const Shape& shape, Part part) {
        read_each(name, type, shape, result_.layers, part);
    }

    Measurement result_;
    bool without_groups_ = false;
    std::vector<Digest> digests_;  ///< of the fields that the table of checksums covers
};

}  // namespace

std::string save_measurement(const Measurement& measurement, const std::string& path) {
    if (const std::string why = contradiction(measurement); !why.empty())
        throw Error(ErrorCode::InvalidInput, "the measurement contradicts itself: " + why, path);
    const ResultFields fields(measurement, true);
    write_tensor_file(path, fields.blocks());
    return fields.checksum();
}

Measurement load_measurement(const std::string& path) {
    const TensorFile file(path);
    try {
        return ResultReader(file).read();
    } catch (const std::bad_alloc&) {
        throw Error(ErrorCode::OutOfMemory, "too large for the memory there is", path);
    }
}

ResultHead load_head(const std::string& path) {
    const TensorFile file(path);
    try {
        return ResultReader(file).read_head();
    } catch (const std::bad_alloc&) {
        throw Error(ErrorCode::OutOfMemory, "too large for the memory there is", path);
    }
}

ResultHead load_lobes(const std::string& path) {
    const TensorFile file(path);
    try {
        return ResultReader(file).read_lobes();
    } catch (const std::bad_alloc&) {
        throw Error(ErrorCode::OutOfMemory, "too large for the memory there is", path);
    }
}

bool looks_like_result(const std::string& path) {
    return looks_like_tensor_file(path);
}

std::string checksum(const Measurement& measurement) {
    return ResultFields::checksum_of(measurement);
}

}  // namespace asperity::io
