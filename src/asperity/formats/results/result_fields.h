// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <asperity/formats/results/field_digest.h>
#include <asperity/formats/results/spared_layer.h>
#include <asperity/formats/results/tensor_file.h>
#include <asperity/gonio/measurement.h>

#include <cstddef>
#include <cstdint>
#include <deque>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace asperity::io {

/// Whether a field counts in the checksum of the whole. Those that came with format 2 do not, nor
/// "provenance", and "format" counts as 1: so equal results have equal checksums in all formats.
bool in_checksum(std::string_view name);
/// What stands for "format" there.
Digest format_digest();

/// Per channel and cell, over all orders; `size` is channels times cells.
std::vector<std::uint64_t> energy_of_all_orders(const Layer& layer, std::size_t size);

/// A Measurement as fields of a container: first those that depend on nothing but the experiment,
/// then what more batches can be added to, "provenance" (how it was run), "checksum" and
/// "field_checksums" (one row per field before it). docs/formats.md lists them all.
///
/// The large arrays are not copied (but one, which is told from two others) unless they are packed:
/// the measurement must outlive this object.
class ResultFields {
  public:
    /// `packed`: large fields are to be stored packed, without what follows from the rest
    /// (SparedLayer), which takes some time.
    explicit ResultFields(const Measurement& measurement, bool packed = false);
    /// Only those that depend on nothing but the experiment, which is enough for the checksum.
    static std::string checksum_of(const Measurement& measurement);
    ResultFields(const ResultFields&) = delete;
    ResultFields& operator=(const ResultFields&) = delete;

    std::span<const TensorBlock> blocks() const { return blocks_; }
    const std::string& checksum() const { return checksum_; }

  private:
    struct CountedAlone {};
    ResultFields(const Measurement& measurement, CountedAlone alone);
    void add_counted();

    void add_text(const char* name, std::string text);
    /// One value per layer.
    template <typename T>
    void add_scalars(const char* name, TensorType type, T Layer::*member);
    /// One array per layer, of this shape.
    template <typename T>
    void add_arrays(const char* name, TensorType type, std::vector<std::uint64_t> shape,
                    std::vector<T> Layer::*member);
    template <typename T>
    void add_values(const char* name, TensorType type, std::vector<std::uint64_t> shape,
                    std::span<const T> values);
    void add_layers();
    /// What the errors come from, if all layers tell.
    void add_spreads();
    /// What tells the noise of the rays from that of the surfaces, if there are several.
    void add_halves();
    void add_energy_of_rays();
    void add_groups();
    /// An array that layers without it do not need; none if all are so.
    void add_where_needed(const char* name, std::vector<std::uint64_t> LayerSpread::*member);
    void add_wide(const char* name, std::vector<std::uint64_t> shape,
                  std::vector<LayerSums::Spread> LayerSpread::*member);
    void sum_up();
    /// Puts what SparedLayer holds in place of what it was made of.
    void leave_out();
    void pack_large();
    void add_checksums();

    const Measurement& measurement_;
    const bool packed_;
    std::deque<std::vector<std::byte>> store_;  ///< what the measurement does not hold as bytes
    std::vector<SparedLayer> spared_;
    std::vector<TensorBlock> blocks_;
    std::string checksum_;
};

/// The JSON texts of the fields "channel_names", "surface" and "provenance", and back. Reading
/// throws nlohmann's exceptions.
std::string channel_names_json(const Measurement& measurement);
std::string surface_json(const Measurement& measurement);
std::string provenance_json(const Measurement& measurement);
void read_channel_names_json(const std::string& text, Measurement& measurement);
void read_surface_json(const std::string& text, Measurement& measurement);
void read_provenance_json(const std::string& text, Measurement& measurement);

}  // namespace asperity::io
