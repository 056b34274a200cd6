// SPDX-License-Identifier: Apache-2.0
#include <asperity/formats/results/result_file.h>

#include <asperity/core/error.h>
#include <asperity/formats/results/result_fields.h>
#include <asperity/gonio/experiment_text.h>
#include <asperity/gonio/measurement_check.h>
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <new>

namespace asperity::io {
namespace {

constexpr std::uint64_t kMaxTextBytes = 16 << 20;

// Turns the fields of an open container back into a Measurement.
class ResultReader {
  public:
    explicit ResultReader(const TensorFile& file) : file_(file) {}

    Measurement read() {
        check_format();
        check_checksums();
        read_settings();
        read_layers();
        read_spreads();
        if (const std::string why = contradiction(result_); !why.empty())
            file_.fail(file_.find("energy")->offset, why);
        return std::move(result_);
    }

  private:
    using Shape = std::vector<std::uint64_t>;

    void check_format() const {
        const TensorField* field = file_.find("format");
        if (field == nullptr) file_.fail(0, "a tensor file, but no result of Asperity");
        const auto format = values<std::uint32_t>("format", TensorType::U32, {1}).front();
        if (format == 0 || format > static_cast<std::uint32_t>(kResultFormat))
            file_.fail(field->offset, fmt::format("format {} is not known here, at most {} is",
                                                  format, kResultFormat));
    }

    // Every byte is covered: the checksums cover the fields, the layout leaves none between them.
    void check_checksums() const {
        file_.require_own_layout();
        const auto& fields = file_.fields();
        if (fields.size() < 3 || fields[fields.size() - 2].name != "field_checksums" ||
            fields.back().name != "checksum")
            file_.fail(0, "the checksums are missing");
        const std::size_t count = fields.size() - 2;
        const auto stored = values<std::uint64_t>("field_checksums", TensorType::U64, {count, 2});

        std::vector<Digest> stable;
        for (std::size_t k = 0; k < count; ++k) {
            const TensorField& field = fields[k];
            const Digest digest = stored_digest_of(file_, field);
            if (digest != Digest{stored[2 * k], stored[2 * k + 1]})
                file_.fail(
                    fields[k].offset,
                    fmt::format("field '{}' is damaged: its {} bytes do not fit its checksum",
                                fields[k].name, fields[k].bytes));
            if (!in_checksum(field.name)) continue;
            if (field.name == "format")
                stable.push_back(format_digest());
            else
                stable.push_back(field.packed ? digest_of(file_, field) : digest);
        }
        if (text("checksum") != checksum_of(stable))
            file_.fail(fields.back().offset, "the checksum of the whole does not fit");
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
        const std::uint64_t rows = extent(result_.detector.rows());
        const std::uint64_t columns = extent(result_.detector.columns());
        const std::uint64_t orders = extent(result_.orders());
        const std::uint64_t bounces = extent(result_.bounces());
        read_arrays("energy", TensorType::U64, {count, orders, channels, rows, columns},
                    &Layer::energy);
        read_arrays("escaped", TensorType::U64, {count, channels}, &Layer::escaped);
        read_arrays("absorbed", TensorType::U64, {count, channels}, &Layer::absorbed);
        read_arrays("truncated", TensorType::U64, {count, channels}, &Layer::truncated);
        read_arrays("edge", TensorType::U64, {count, channels}, &Layer::edge);
        read_arrays("escaped_by_bounce", TensorType::U64, {count, channels, bounces},
                    &Layer::escaped_by_bounce);
        read_arrays("stderr_energy", TensorType::F32, {count, channels, rows, columns},
                    &Layer::stderr_energy);
        read_arrays("stderr_albedo", TensorType::F64, {count, channels}, &Layer::stderr_albedo);
        read_arrays("stderr_albedo_by_bounce", TensorType::F64, {count, channels, bounces},
                    &Layer::stderr_albedo_by_bounce);
    }

    void read_spreads() {
        for (const char* axis : {"sides", "elements"})
            if (const TensorField* found = file_.find(axis);
                found && values<std::uint32_t>(axis, TensorType::U32, {1}).front() != 1)
                file_.fail(found->offset, fmt::format("more {} than one are not known here", axis));
        if (file_.find("energy_squares") == nullptr) return;
        const std::uint64_t count = result_.layers.size(), channels = extent(result_.channels());
        const Shape cells = {count, channels, extent(result_.detector.rows()),
                             extent(result_.detector.columns())};
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
        if (file_.find("batches_reached") != nullptr) read_groups(cells);
        if (file_.find("energy_halves") != nullptr) read_halves(cells);
    }

    void read_halves(const Shape& cells) {
        read_parts(
            "energy_halves", TensorType::U64, {cells[0], cells[1], cells[2], cells[3], 2},
            [](Layer & layer) -> auto& { return layer.spread.halves.cells; });
        read_parts(
            "escaped_halves", TensorType::U64, {cells[0], cells[1], 2},
            [](Layer & layer) -> auto& { return layer.spread.halves.albedo; });
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

    static std::uint64_t extent(int count) { return static_cast<std::uint64_t>(count); }

    const TensorField& field(const char* name, TensorType type, const Shape& shape) const {
        const TensorField& field = file_.require(name, type, shape.size());
        if (field.shape != shape)
            file_.fail(field.entry, fmt::format("field '{}' does not have the shape of the "
                                                "experiment",
                                                name));
        return field;
    }

    template <typename T>
    std::vector<T> values(const char* name, TensorType type, const Shape& shape) const {
        const TensorField& found = field(name, type, shape);
        std::vector<T> numbers(static_cast<std::size_t>(found.bytes) / sizeof(T));
        file_.read(found, 0, std::as_writable_bytes(std::span(numbers)));
        return numbers;
    }

    std::string text(const char* name) const {
        const TensorField& found = file_.require(name, TensorType::U8, 1);
        if (found.bytes > kMaxTextBytes)
            file_.fail(found.entry, fmt::format("field '{}' is too long for a text", name));
        std::string characters(static_cast<std::size_t>(found.bytes), '\0');
        file_.read(found, 0, std::as_writable_bytes(std::span(characters)));
        return characters;
    }

    // Whatever the text does not say right becomes an error about its field.
    template <typename Read>
    void try_reading(const char* name, Read&& read) const {
        const std::string characters = text(name);
        try {
            read(characters);
        } catch (const std::bad_alloc&) {
            throw;
        } catch (const std::exception& error) {
            file_.fail(file_.find(name)->offset, fmt::format("field '{}': {}", name, error.what()));
        }
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
        const TensorField& found = field(name, type, shape);
        const std::size_t layers = result_.layers.size();
        for (std::size_t k = 0; k < layers; ++k) {
            const std::uint64_t bytes = found.bytes / layers;
            auto& numbers = part(result_.layers[k]);
            numbers.resize(static_cast<std::size_t>(bytes) / sizeof(numbers[0]));
            file_.read(found, k * bytes, std::as_writable_bytes(std::span(numbers)));
        }
    }

    const TensorFile& file_;
    Measurement result_;
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

bool looks_like_result(const std::string& path) {
    return looks_like_tensor_file(path);
}

std::string checksum(const Measurement& measurement) {
    return ResultFields(measurement).checksum();
}

}  // namespace asperity::io
