// SPDX-License-Identifier: Apache-2.0
#include <asperity/formats/results/result_fields.h>

#include <asperity/core/parallel.h>
#include <asperity/core/run.h>
#include <asperity/formats/results/result_file.h>
#include <asperity/formats/results/spared_fields.h>
#include <asperity/gonio/experiment_text.h>
#include <asperity/gonio/noise_shares.h>

#include <algorithm>
#include <array>
#include <bit>
#include <utility>

namespace asperity::io {
namespace {

constexpr const char* kDescription =
    "Asperity: simulated reflection of a rough surface. energy[layer, order, channel, row, column] "
    "counts in 2^-32 of one of the `rays` launched; row 0 touches the normal, rows end at "
    "theta_edges [rad], columns divide the azimuth equally from 0 on.";

static_assert(std::endian::native == std::endian::little,
              "sums of squares are stored low word first");

std::uint64_t extent(int count) {
    return static_cast<std::uint64_t>(count);
}

}  // namespace

std::vector<std::uint64_t> energy_of_all_orders(const Layer& layer, std::size_t size) {
    std::vector<std::uint64_t> sums(size);
    for (std::size_t k = 0; k < layer.energy.size() && size > 0; ++k)
        sums[k % size] += layer.energy[k];
    return sums;
}

ResultFields::ResultFields(const Measurement& measurement, bool packed)
    : measurement_(measurement), packed_(packed) {
    add_counted();
    add_spreads();
    add_text("provenance", provenance_json(measurement));
    sum_up();
    if (packed) {
        leave_out();
        pack_large();
    }
    add_checksums();
}

ResultFields::ResultFields(const Measurement& measurement, CountedAlone)
    : measurement_(measurement), packed_(false) {
    add_counted();
    sum_up();
}

std::string ResultFields::checksum_of(const Measurement& measurement) {
    return ResultFields(measurement, CountedAlone()).checksum();
}

void ResultFields::add_counted() {
    const Measurement& measurement = measurement_;
    add_text("description", kDescription);
    const auto format = static_cast<std::uint32_t>(kResultFormat);
    add_values<std::uint32_t>("format", TensorType::U32, {1}, std::span(&format, 1));
    add_text("experiment", to_text(measurement.experiment));
    add_text("channel_names", channel_names_json(measurement));
    add_text("surface", surface_json(measurement));
    add_layers();
}

void ResultFields::add_layers() {
    const Detector& detector = measurement_.detector;
    std::vector<double> edges;
    for (int row = 0; row <= detector.rows(); ++row) edges.push_back(detector.theta_edge(row));
    add_values<double>("theta_edges", TensorType::F64, {edges.size()}, edges);

    add_scalars("layer_number", TensorType::I32, &Layer::number);
    add_scalars("theta_i", TensorType::F64, &Layer::theta_i);
    add_scalars("phi_i", TensorType::F64, &Layer::phi_i);
    add_scalars("rays", TensorType::U64, &Layer::rays);
    add_scalars("segments", TensorType::U64, &Layer::segments);
    add_scalars("reflections", TensorType::U64, &Layer::reflections);
    add_scalars("stuck", TensorType::U64, &Layer::stuck);
    add_scalars("batches", TensorType::I32, &Layer::batches);

    const std::uint64_t channels = extent(measurement_.channels());
    const std::uint64_t rows = extent(detector.rows()), columns = extent(detector.columns());
    const std::uint64_t bounces = extent(measurement_.bounces());
    add_arrays("energy", TensorType::U64, {extent(measurement_.orders()), channels, rows, columns},
               &Layer::energy);
    add_arrays("escaped", TensorType::U64, {channels}, &Layer::escaped);
    add_arrays("absorbed", TensorType::U64, {channels}, &Layer::absorbed);
    add_arrays("truncated", TensorType::U64, {channels}, &Layer::truncated);
    add_arrays("edge", TensorType::U64, {channels}, &Layer::edge);
    add_arrays("escaped_by_bounce", TensorType::U64, {channels, bounces},
               &Layer::escaped_by_bounce);
    add_arrays("stderr_energy", TensorType::F32, {channels, rows, columns}, &Layer::stderr_energy);
    add_arrays("stderr_albedo", TensorType::F64, {channels}, &Layer::stderr_albedo);
    add_arrays("stderr_albedo_by_bounce", TensorType::F64, {channels, bounces},
               &Layer::stderr_albedo_by_bounce);
}

void ResultFields::add_spreads() {
    const auto one = std::uint32_t{1};
    add_values<std::uint32_t>("sides", TensorType::U32, {1}, std::span(&one, 1));
    add_values<std::uint32_t>("elements", TensorType::U32, {1}, std::span(&one, 1));
    const std::vector<Layer>& layers = measurement_.layers;
    const auto all_know = [&](auto LayerSpread::*member) {
        return std::all_of(layers.begin(), layers.end(),
                           [=](const Layer& layer) { return !(layer.spread.*member).empty(); });
    };
    if (!all_know(&LayerSpread::squares)) return;
    const std::uint64_t channels = extent(measurement_.channels());
    const std::uint64_t rows = extent(measurement_.detector.rows());
    const std::uint64_t columns = extent(measurement_.detector.columns());

    std::vector<std::uint64_t> largest, done;
    for (std::size_t k = 0; k < layers.size(); ++k) {
        const LayerSpread& spread = layers[k].spread;
        largest.push_back(spread.largest_batch);
        for (const BatchRange& r : spread.done.ranges())
            done.insert(done.end(), {std::uint64_t{k}, r.begin, r.end});
    }
    add_values<std::uint64_t>("largest_batch", TensorType::U64, {largest.size()}, largest);
    add_values<std::uint64_t>("batches_done", TensorType::U64, {done.size() / 3, 3}, done);

    TensorBlock squares = {
        "energy_squares", TensorType::U64, {layers.size(), channels, rows, columns, 2}, {}};
    for (const Layer& layer : layers)
        squares.parts.push_back(std::as_bytes(std::span(layer.spread.squares)));
    blocks_.push_back(std::move(squares));
    add_where_needed("energy_stretched", &LayerSpread::stretched);
    add_wide("escaped_by_bounce_spread", {channels, extent(measurement_.bounces())},
             &LayerSpread::bounces);
    add_wide("escaped_spread", {channels}, &LayerSpread::albedo);
    add_halves();
    if (all_know(&LayerSpread::reached)) add_groups();
}

void ResultFields::add_halves() {
    const std::vector<Layer>& layers = measurement_.layers;
    if (!std::all_of(layers.begin(), layers.end(),
                     [](const Layer& layer) { return !layer.spread.halves.cells.empty(); }))
        return;
    const std::uint64_t channels = extent(measurement_.channels());
    const std::uint64_t rows = extent(measurement_.detector.rows());
    const std::uint64_t columns = extent(measurement_.detector.columns());
    TensorBlock cells = {
        "energy_halves", TensorType::U64, {layers.size(), channels, rows, columns, 2}, {}};
    TensorBlock all = {"escaped_halves", TensorType::U64, {layers.size(), channels, 2}, {}};
    for (const Layer& layer : layers) {
        cells.parts.push_back(std::as_bytes(std::span(layer.spread.halves.cells)));
        all.parts.push_back(std::as_bytes(std::span(layer.spread.halves.albedo)));
    }
    blocks_.push_back(std::move(cells));
    blocks_.push_back(std::move(all));
    std::vector<double> noise(2 * layers.size());
    parallel_for(layers.size(), Run().threads(), [&](std::size_t k) {
        const CellNoise sums = cell_noise_of(layers[k]).value_or(CellNoise());
        noise[2 * k] = sums.rays;
        noise[2 * k + 1] = sums.both;
    });
    add_values<double>("cell_noise", TensorType::F64, {layers.size(), 2}, noise);
}

void ResultFields::add_where_needed(const char* name,
                                    std::vector<std::uint64_t> LayerSpread::*member) {
    const std::vector<Layer>& layers = measurement_.layers;
    const auto has = [&](const Layer& layer) { return !(layer.spread.*member).empty(); };
    if (std::none_of(layers.begin(), layers.end(), has)) return;
    const std::uint64_t channels = extent(measurement_.channels());
    const std::uint64_t rows = extent(measurement_.detector.rows());
    const std::uint64_t columns = extent(measurement_.detector.columns());
    TensorBlock block = {name, TensorType::U64, {layers.size(), channels, rows, columns}, {}};
    // A layer that has nothing to add
    const auto& none = store_.emplace_back(channels * rows * columns * sizeof(std::uint64_t));
    for (const Layer& layer : layers)
        block.parts.push_back(has(layer) ? std::as_bytes(std::span(layer.spread.*member))
                                         : std::span<const std::byte>(none));
    blocks_.push_back(std::move(block));
}

/// In place of what known facets brought: mostly nothing, so that it takes a quarter of the room.
void ResultFields::add_energy_of_rays() {
    if (packed_) return;  // SparedLayer has it otherwise
    const std::vector<Layer>& layers = measurement_.layers;
    const auto has = [](const Layer& layer) { return !layer.spread.exact.empty(); };
    if (std::none_of(layers.begin(), layers.end(), has)) return;
    const std::uint64_t channels = extent(measurement_.channels());
    const std::uint64_t rows = extent(measurement_.detector.rows());
    const std::uint64_t columns = extent(measurement_.detector.columns());
    std::vector<std::uint64_t> of_rays;
    for (const Layer& layer : layers) {
        std::vector<std::uint64_t> cells = energy_of_all_orders(layer, channels * rows * columns);
        for (std::size_t k = 0; has(layer) && k < cells.size(); ++k)
            cells[k] -= layer.spread.exact[k];
        of_rays.insert(of_rays.end(), cells.begin(), cells.end());
    }
    add_values<std::uint64_t>("energy_of_rays", TensorType::U64,
                              {layers.size(), channels, rows, columns}, of_rays);
}

void ResultFields::add_groups() {
    const std::vector<Layer>& layers = measurement_.layers;
    const std::uint64_t channels = extent(measurement_.channels());
    add_wide("escaped_spread_by_age", {LayerSums::kAges, channels}, &LayerSpread::albedo_by_age);
    add_energy_of_rays();
    const CoarseGrid grid(measurement_.shape());
    TensorBlock reached = {"batches_reached",
                           TensorType::U32,
                           {layers.size(), channels, extent(measurement_.detector.rows()),
                            extent(measurement_.detector.columns())},
                           {}};
    TensorBlock rays = {"group_rays", TensorType::U64, {layers.size(), GroupSums::kGroups}, {}};
    TensorBlock energy = {"group_energy",
                          TensorType::U64,
                          {layers.size(), GroupSums::kGroups, grid.down, grid.across, channels},
                          {}};
    for (const Layer& layer : layers) {
        reached.parts.push_back(std::as_bytes(std::span(layer.spread.reached)));
        rays.parts.push_back(std::as_bytes(std::span(layer.spread.groups.rays)));
        energy.parts.push_back(std::as_bytes(std::span(layer.spread.groups.energy)));
    }
    for (TensorBlock* block : {&reached, &rays, &energy}) blocks_.push_back(std::move(*block));
}

void ResultFields::add_wide(const char* name, std::vector<std::uint64_t> shape,
                            std::vector<LayerSums::Spread> LayerSpread::*member) {
    std::vector<std::uint64_t> words;
    for (const Layer& layer : measurement_.layers)
        for (const LayerSums::Spread& s : layer.spread.*member)
            words.insert(words.end(), {s.sum, static_cast<std::uint64_t>(s.squares),
                                       static_cast<std::uint64_t>(s.squares >> 64)});
    shape.insert(shape.begin(), measurement_.layers.size());
    shape.push_back(3);
    add_values<std::uint64_t>(name, TensorType::U64, std::move(shape), words);
}

bool in_checksum(std::string_view name) {
    constexpr std::array<std::string_view, 32> kLeftOut = {"provenance",
                                                           "sides",
                                                           "elements",
                                                           "largest_batch",
                                                           "batches_done",
                                                           "energy_squares",
                                                           "energy_stretched",
                                                           "escaped_spread",
                                                           "escaped_by_bounce_spread",
                                                           "energy_of_rays",
                                                           "group_rays",
                                                           "escaped_spread_by_age",
                                                           "batches_reached",
                                                           "group_energy",
                                                           "energy_halves",
                                                           "escaped_halves",
                                                           "cell_noise",
                                                           "path_counts",
                                                           "energy_of_a_path",
                                                           "energy_zeros",
                                                           "sum_zeros",
                                                           "path_squares_rest",
                                                           "energy_squares_rest",
                                                           "path_group_rest",
                                                           "group_energy_rest",
                                                           "path_halves_rest",
                                                           "energy_halves_rest",
                                                           "energy_known",
                                                           "known_unit",
                                                           "known_squares",
                                                           "known_of_group",
                                                           "checksum"};
    return std::find(kLeftOut.begin(), kLeftOut.end(), name) == kLeftOut.end();
}

Digest format_digest() {
    constexpr std::uint32_t kFirst = 1;
    constexpr std::uint64_t kShape = 1;
    FieldDigest digest("format", TensorType::U32, std::span(&kShape, 1));
    digest.update(std::as_bytes(std::span(&kFirst, 1)));
    return digest.finish();
}

void ResultFields::sum_up() {
    std::vector<Digest> counted;
    for (const TensorBlock& block : blocks_)
        if (in_checksum(block.name))
            counted.push_back(block.name == "format" ? format_digest() : digest_of(block));
    checksum_ = io::checksum_of(counted);
}

void ResultFields::leave_out() {
    const std::vector<Layer>& layers = measurement_.layers;
    const auto holds_all = [](const Layer& layer) {
        return !layer.spread.squares.empty() && !layer.spread.reached.empty();
    };
    if (layers.empty() || !std::all_of(layers.begin(), layers.end(), holds_all)) return;
    const SumShape shape = measurement_.shape();
    spared_.resize(layers.size());
    parallel_for(layers.size(), Run().threads(),
                 [&](std::size_t k) { spared_[k] = spare(layers[k], shape); });
    const bool errors_follow = std::all_of(spared_.begin(), spared_.end(),
                                           [](const SparedLayer& s) { return s.errors_follow; });
    std::erase_if(blocks_, [&](const TensorBlock& b) {
        return b.name == "energy_squares" || b.name == "group_energy" ||
               b.name == "energy_halves" || (errors_follow && b.name == "stderr_energy");
    });
    for (TensorBlock& block : spared_blocks(spared_, shape)) {
        const auto energy = [&](const TensorBlock& b) {
            return block.name == kEnergyRest && b.name == "energy";
        };
        const auto found = std::find_if(blocks_.begin(), blocks_.end(), energy);
        if (found != blocks_.end())
            *found = std::move(block);
        else
            blocks_.push_back(std::move(block));
    }
}

void ResultFields::pack_large() {
    for (TensorBlock& block : blocks_) {
        block.sorted = size_of(block.type) > 1;
        block.packed = store_.emplace_back(
            pack(block.parts, block.sorted ? static_cast<std::size_t>(size_of(block.type)) : 1));
    }
}

void ResultFields::add_checksums() {
    add_text("checksum", checksum_);
    std::vector<std::uint64_t> words;
    for (const TensorBlock& block : blocks_) {
        const Digest digest = stored_digest_of(block);
        words.insert(words.end(), digest.begin(), digest.end());
    }
    add_values<std::uint64_t>("field_checksums", TensorType::U64, {blocks_.size(), 2}, words);
}

void ResultFields::add_text(const char* name, std::string text) {
    add_values<char>(name, TensorType::U8, {text.size()}, text);
}

template <typename T>
void ResultFields::add_values(const char* name, TensorType type, std::vector<std::uint64_t> shape,
                              std::span<const T> values) {
    const auto bytes = std::as_bytes(values);
    const auto& kept = store_.emplace_back(bytes.begin(), bytes.end());
    blocks_.push_back({name, type, std::move(shape), {kept}});
}

template <typename T>
void ResultFields::add_scalars(const char* name, TensorType type, T Layer::*member) {
    std::vector<T> values;
    for (const Layer& layer : measurement_.layers) values.push_back(layer.*member);
    add_values<T>(name, type, {values.size()}, values);
}

template <typename T>
void ResultFields::add_arrays(const char* name, TensorType type, std::vector<std::uint64_t> shape,
                              std::vector<T> Layer::*member) {
    shape.insert(shape.begin(), measurement_.layers.size());
    TensorBlock block = {name, type, std::move(shape), {}};
    for (const Layer& layer : measurement_.layers)
        block.parts.push_back(std::as_bytes(std::span(layer.*member)));
    blocks_.push_back(std::move(block));
}

}  // namespace asperity::io
