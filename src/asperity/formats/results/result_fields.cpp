// SPDX-License-Identifier: Apache-2.0
#include <asperity/formats/results/result_fields.h>

#include <asperity/formats/results/result_file.h>
#include <asperity/gonio/experiment_text.h>

#include <utility>

namespace asperity::io {
namespace {

constexpr const char* kDescription =
    "Asperity: simulated reflection of a rough surface. energy[layer, order, channel, row, column] "
    "counts in 2^-32 of one of the `rays` launched; row 0 touches the normal, rows end at "
    "theta_edges [rad], columns divide the azimuth equally from 0 on.";

std::uint64_t extent(int count) {
    return static_cast<std::uint64_t>(count);
}

}  // namespace

ResultFields::ResultFields(const Measurement& measurement) : measurement_(measurement) {
    add_text("description", kDescription);
    const auto format = static_cast<std::uint32_t>(kResultFormat);
    add_values<std::uint32_t>("format", TensorType::U32, {1}, std::span(&format, 1));
    add_text("experiment", to_text(measurement.experiment));
    add_text("channel_names", channel_names_json(measurement));
    add_text("surface", surface_json(measurement));
    add_layers();
    add_text("provenance", provenance_json(measurement));
    add_checksums();
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

// The last field before the checksums, "provenance", may differ between equal experiments and stays
// out of the one checksum.
void ResultFields::add_checksums() {
    std::vector<Digest> digests;
    for (const TensorBlock& block : blocks_) digests.push_back(digest_of(block));
    checksum_ = checksum_of(std::span(digests).first(digests.size() - 1));
    std::vector<std::uint64_t> words;
    for (const Digest& digest : digests) words.insert(words.end(), digest.begin(), digest.end());
    add_values<std::uint64_t>("field_checksums", TensorType::U64, {digests.size(), 2}, words);
    add_text("checksum", checksum_);
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
