// SPDX-License-Identifier: Apache-2.0
#include <asperity/formats/results/spared_fields.h>

#include <asperity/formats/results/field_reader.h>

#include <fmt/format.h>

#include <algorithm>

namespace asperity::io {

namespace {

constexpr std::uint64_t kGroups = GroupSums::kGroups;

/// Makes fields of what each layer has.
class SparedBlocks {
  public:
    explicit SparedBlocks(std::span<const SparedLayer> layers) : layers_(layers) {}

    /// `axes` come behind that of the layers for which `needed` holds.
    template <class Part, class Needed>
    void add(std::string_view name, TensorType type, std::vector<std::uint64_t> axes, Part part,
             Needed needed) {
        TensorBlock block = {std::string(name), type, {0}, {}};
        for (const SparedLayer& layer : layers_)
            if (needed(layer)) {
                block.parts.push_back(std::as_bytes(std::span(part(layer))));
                ++block.shape[0];
            }
        block.shape.insert(block.shape.end(), axes.begin(), axes.end());
        blocks_.push_back(std::move(block));
    }
    template <class Part>
    void add(std::string_view name, TensorType type, std::vector<std::uint64_t> axes, Part part) {
        add(name, type, std::move(axes), part, [](const SparedLayer&) { return true; });
    }

    std::vector<TensorBlock> blocks() && { return std::move(blocks_); }

  private:
    std::span<const SparedLayer> layers_;
    std::vector<TensorBlock> blocks_;
};

class SparedReader : FieldReader {
  public:
    SparedReader(const TensorFile& file, std::size_t count, const SumShape& shape, bool groups)
        : FieldReader(file),
          shape_(shape),
          grid_(shape),
          rows_(shape.cells / shape.columns),
          layers_(count),
          groups_(groups) {}

    std::vector<SparedLayer> read() {
        read_words(
            "energy_squares_rest", {2, shape_.channels, rows_, shape_.columns},
            [](SparedLayer & s) -> auto& { return s.squares; });
        if (groups_)
            read_words(
                "group_energy_rest", {shape_.channels, kGroups, grid_.down, grid_.across},
                [](SparedLayer & s) -> auto& { return s.groups; });
        // What may be told by little comes last: by now the file has shown its size
        if (file_.find(kEnergyRest) != nullptr) read_paths();
        if (file_.find("known_unit") != nullptr) read_known();
        return std::move(layers_);
    }

  private:
    template <class Part>
    void read_words(const char* name, Shape axes, Part part) {
        axes.insert(axes.begin(), layers_.size());
        read_each(name, TensorType::U64, axes, layers_, part);
    }

    void read_paths() {
        const std::uint64_t count = layers_.size();
        const std::uint64_t orders = shape_.orders, channels = shape_.channels;
        // Of no layer where all are 0
        if (file_.require(kEnergyRest, TensorType::U64, 5).shape[0] == 0)
            for (SparedLayer& s : layers_) s.energy.rests.resize(orders * channels * shape_.cells);
        else
            read_words(
                "energy_rest", {orders, channels, rows_, shape_.columns},
                [](SparedLayer & s) -> auto& { return s.energy.rests; });
        read_each(
            "path_counts", TensorType::U32, {count, orders, rows_, shape_.columns}, layers_,
            [](SparedLayer & s) -> auto& { return s.energy.paths; });
        read_words(
            "energy_of_a_path", {orders, channels},
            [](SparedLayer & s) -> auto& { return s.energy.of_path; });
        read_each(
            "energy_zeros", TensorType::U8, {count, orders, channels}, layers_,
            [](SparedLayer & s) -> auto& { return s.energy.zeros; });
        read_each(
            "sum_zeros", TensorType::U8, {count, SparedLayer::kKinds, channels}, layers_,
            [](SparedLayer & s) -> auto& { return s.zeros; });
        check_zeros();
        read_words(
            "path_squares_rest", {rows_, shape_.columns},
            [](SparedLayer & s) -> auto& { return s.path_squares; });
        if (groups_)
            read_words(
                "path_group_rest", {kGroups, grid_.down, grid_.across},
                [](SparedLayer & s) -> auto& { return s.path_groups; });
        if (file_.find("energy_halves_rest") == nullptr) return;
        read_words(
            "energy_halves_rest", {2, channels, rows_, shape_.columns},
            [](SparedLayer & s) -> auto& { return s.halves; });
        read_words(
            "path_halves_rest", {rows_, shape_.columns},
            [](SparedLayer & s) -> auto& { return s.path_halves; });
    }

    void check_zeros() const {
        for (const SparedLayer& s : layers_) {
            for (const std::uint8_t zeros : s.energy.zeros) require_less("energy_zeros", zeros, 64);
            for (std::size_t k = 0; k < s.zeros.size(); ++k)
                require_less("sum_zeros", s.zeros[k],
                             k / shape_.channels == SparedLayer::kGroups ? 64 : 128);
        }
    }
    void require_less(const char* name, unsigned zeros, unsigned bits) const {
        if (zeros >= bits)
            file_.fail(file_.find(name)->offset,
                       fmt::format("field '{}': no number of {} bits is divided by 2^{}", name,
                                   bits, zeros));
    }

    void read_known() {
        const std::uint64_t count = layers_.size();
        const auto unit = values<std::uint64_t>("known_unit", TensorType::U64, {count});
        const auto squares = values<std::uint64_t>("known_squares", TensorType::U64, {count, 2});
        read_words(
            "known_of_group", {kGroups}, [](SparedLayer & s) -> auto& { return s.known_of_group; });
        std::vector<SparedLayer*> known;
        for (std::size_t k = 0; k < layers_.size(); ++k) {
            layers_[k].known_unit = unit[k];
            layers_[k].known_squares = (LayerSums::Wide{squares[2 * k + 1]} << 64) | squares[2 * k];
            if (unit[k] != 0) known.push_back(&layers_[k]);
        }
        read_each(
            "energy_known", TensorType::U64, {known.size(), shape_.channels, rows_, shape_.columns},
            known, [](SparedLayer * s) -> auto& { return s->known; });
    }

    const SumShape& shape_;
    CoarseGrid grid_;
    std::uint64_t rows_;
    std::vector<SparedLayer> layers_;
    bool groups_;
};

}  // namespace

std::vector<TensorBlock> spared_blocks(std::span<const SparedLayer> layers, const SumShape& shape) {
    using Layer = SparedLayer;
    const std::uint64_t orders = shape.orders, channels = shape.channels;
    const std::uint64_t rows = shape.cells / shape.columns, columns = shape.columns;
    const CoarseGrid grid(shape);
    constexpr TensorType kU64 = TensorType::U64;
    SparedBlocks all(layers);
    const bool some_energy = std::any_of(layers.begin(), layers.end(), [](const Layer& s) {
        return std::any_of(s.energy.rests.begin(), s.energy.rests.end(),
                           [](std::uint64_t rest) { return rest != 0; });
    });
    all.add(
        kEnergyRest, kU64, {orders, channels, rows, columns},
        [](const Layer& s) -> auto& { return s.energy.rests; },
        [&](const Layer&) { return some_energy; });
    all.add(
        "path_counts", TensorType::U32, {orders, rows, columns},
        [](const Layer& s) -> auto& { return s.energy.paths; });
    all.add(
        "energy_of_a_path", kU64, {orders, channels},
        [](const Layer& s) -> auto& { return s.energy.of_path; });
    all.add(
        "energy_zeros", TensorType::U8, {orders, channels},
        [](const Layer& s) -> auto& { return s.energy.zeros; });
    all.add(
        "sum_zeros", TensorType::U8, {SparedLayer::kKinds, channels},
        [](const Layer& s) -> auto& { return s.zeros; });
    all.add(
        "path_squares_rest", kU64, {rows, columns},
        [](const Layer& s) -> auto& { return s.path_squares; });
    all.add(
        "energy_squares_rest", kU64, {2, channels, rows, columns},
        [](const Layer& s) -> auto& { return s.squares; });
    all.add(
        "path_group_rest", kU64, {kGroups, grid.down, grid.across},
        [](const Layer& s) -> auto& { return s.path_groups; });
    all.add(
        "group_energy_rest", kU64, {channels, kGroups, grid.down, grid.across},
        [](const Layer& s) -> auto& { return s.groups; });
    if (std::all_of(layers.begin(), layers.end(),
                    [](const Layer& s) { return !s.halves.empty(); })) {
        all.add(
            "path_halves_rest", kU64, {rows, columns},
            [](const Layer& s) -> auto& { return s.path_halves; });
        all.add(
            "energy_halves_rest", kU64, {2, channels, rows, columns},
            [](const Layer& s) -> auto& { return s.halves; });
    }
    const auto knows = [](const Layer& s) { return s.known_unit != 0; };
    if (std::none_of(layers.begin(), layers.end(), knows)) return std::move(all).blocks();
    all.add("known_unit", kU64, {}, [](const Layer& s) { return std::span(&s.known_unit, 1); });
    all.add("known_squares", kU64, {2},
            [](const Layer& s) { return std::span(&s.known_squares, 1); });
    all.add(
        "known_of_group", kU64, {kGroups},
        [](const Layer& s) -> auto& { return s.known_of_group; });
    all.add(
        "energy_known", kU64, {channels, rows, columns},
        [](const Layer& s) -> auto& { return s.known; }, knows);
    return std::move(all).blocks();
}

std::vector<SparedLayer> read_spared_layers(const TensorFile& file, std::size_t count,
                                            const SumShape& shape, bool groups) {
    return SparedReader(file, count, shape, groups).read();
}

}  // namespace asperity::io
