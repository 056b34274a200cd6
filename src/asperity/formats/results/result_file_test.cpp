// SPDX-License-Identifier: Apache-2.0
#include <asperity/formats/results/result_file.h>

#include <asperity/core/energy.h>
#include <asperity/formats/results/field_digest.h>
#include <asperity/formats/results/result_fields.h>
#include <asperity/formats/results/tensor_file.h>
#include <asperity/formats/test_files.h>
#include <asperity/gonio/experiment_text.h>

#include <limits>
#include <random>
#include <tuple>

namespace asperity::io {
namespace {

using test::error_of;
using test::expect_error;
using test::get;
using test::put;
using test::TemporaryFolder;

// A layer whose energies are random and balanced: the rays are dealt out to fates, the escaped ones
// to cells, and the same sum once more to bounces.
Layer random_layer(const Measurement& m, const Incidence& light, std::mt19937_64& engine) {
    const auto channels = static_cast<std::size_t>(m.channels());
    const auto cells = static_cast<std::size_t>(m.detector.cells());
    const auto slices = static_cast<std::size_t>(m.orders()) * channels;
    const auto bounces = static_cast<std::size_t>(m.bounces());
    Layer layer;
    layer.number = light.number;
    layer.theta_i = light.theta + 1e-17;
    layer.phi_i = light.phi;
    layer.rays = 1000 + engine() % 1000;
    layer.segments = engine(), layer.reflections = engine() % 3000, layer.stuck = engine() % 1000;
    layer.batches = 7;
    layer.escaped_by_bounce.assign(channels * bounces, 0);
    layer.energy.resize(slices * cells);
    layer.escaped.assign(channels, 0);
    for (std::size_t k = 0; k < layer.energy.size(); ++k) {
        const std::size_t channel = k / cells % channels;
        layer.energy[k] = engine() % (layer.rays * kRayEnergy / (2 * layer.energy.size()));
        layer.escaped[channel] += layer.energy[k];
        layer.escaped_by_bounce[channel * bounces + engine() % bounces] += layer.energy[k];
    }
    for (std::size_t channel = 0; channel < channels; ++channel) {
        const std::uint64_t rest = layer.rays * kRayEnergy - layer.escaped[channel];
        layer.absorbed.push_back(rest / 2);
        layer.truncated.push_back(rest / 3);
        layer.edge.push_back(rest - rest / 2 - rest / 3);
    }
    std::uniform_real_distribution<double> uniform;
    for (std::size_t k = 0; k < channels * cells; ++k)
        layer.stderr_energy.push_back(static_cast<float>(uniform(engine)));
    for (std::size_t k = 0; k < channels; ++k) layer.stderr_albedo.push_back(uniform(engine));
    for (std::size_t k = 0; k < channels * bounces; ++k)
        layer.stderr_albedo_by_bounce.push_back(uniform(engine));
    return layer;
}

// What its errors would come from; no less random.
void add_spread(const Measurement& m, Layer& layer, bool stretched, std::mt19937_64& engine) {
    const auto wide = [&] { return (LayerSums::Wide{engine()} << 64) | engine(); };
    LayerSpread& spread = layer.spread;
    spread.largest_batch = engine();
    spread.done.add({2, 5});
    spread.done.add({11, 15});
    for (std::size_t k = 0; k < layer.stderr_energy.size(); ++k) {
        spread.squares.push_back(wide());
        if (stretched) spread.stretched.push_back(engine() | 1);
        if (stretched) spread.exact.push_back(layer.energy[k] / 3);
        spread.reached.push_back(static_cast<std::uint32_t>(engine()));
    }
    for (std::size_t k = 0; k < layer.escaped_by_bounce.size(); ++k)
        spread.bounces.push_back({engine(), wide()});
    for (int c = 0; c < m.channels(); ++c) spread.albedo.push_back({engine(), wide()});
    if (stretched) {
        for (std::size_t k = 0; k < layer.stderr_energy.size(); ++k)
            spread.halves.cells.push_back(wide());
        for (int c = 0; c < m.channels(); ++c) spread.halves.albedo.push_back(wide());
    }
    spread.albedo_by_age.resize(LayerSums::kAges * spread.albedo.size());
    for (LayerSums::Spread& s : spread.albedo_by_age) s = {engine(), wide()};
    spread.groups = GroupSums(m.shape());
    for (auto* array : {&spread.groups.rays, &spread.groups.energy})
        for (std::uint64_t& x : *array) x = engine();
}

Measurement small_measurement(unsigned seed = 1, int layers = 2) {
    std::mt19937_64 engine(seed);
    Measurement m;
    m.experiment.detector = {DetectorKind::EqualArea, 4, 2};
    m.experiment.run.bounces = 3;
    m.experiment.surface.alpha_x = 0.1;
    m.experiment.illumination.layers = std::max(1, layers);
    m.experiment.illumination.phi_deg = {-100.0 / 7};
    m.detector = Detector(m.experiment.detector);
    m.channel_names = {"R", "G", "B"};
    m.surface.rms_height = 1.0 / 3;
    m.surface.skewness = -1e-300;
    m.surface.kurtosis = std::numeric_limits<double>::quiet_NaN();
    m.surface.area_ratio = std::nextafter(1.0, 2.0);
    m.surface_name = "a \"name\"\nwith \xc3\xa9";
    m.surface_nx = 5, m.surface_ny = 6;
    m.surface_dx = 0.1, m.surface_dy = 1e-6;
    m.surface_isotropic = true;
    for (const Incidence& light : incidences(m.experiment.illumination))
        if (layers > 0) m.layers.push_back(random_layer(m, light, engine));
    m.stopped = true;
    m.notes = {"One.", "Two, with a \\."};
    m.trace_seconds = 0.1;
    m.threads = 3;
    m.version = "0.1.0";
    return m;
}

void expect_equal(const Layer& a, const Layer& b) {
    const auto fields = [](const Layer& l) {
        return std::tie(l.number, l.theta_i, l.phi_i, l.rays, l.segments, l.reflections, l.stuck,
                        l.batches, l.energy, l.escaped, l.absorbed, l.truncated, l.edge,
                        l.escaped_by_bounce, l.stderr_energy, l.stderr_albedo,
                        l.stderr_albedo_by_bounce);
    };
    EXPECT_TRUE(fields(a) == fields(b));
}

void expect_equal(const Measurement& a, const Measurement& b) {
    EXPECT_EQ(to_text(a.experiment), to_text(b.experiment));
    const auto fields = [](const Measurement& m) {
        return std::tie(m.channel_names, m.surface_name, m.surface_nx, m.surface_ny, m.surface_dx,
                        m.surface_dy, m.surface_isotropic, m.stopped, m.notes, m.trace_seconds,
                        m.threads, m.version, m.surface.rms_height, m.surface.skewness,
                        m.surface.area_ratio);
    };
    EXPECT_TRUE(fields(a) == fields(b));
    EXPECT_EQ(a.detector.cells(), b.detector.cells());
    ASSERT_EQ(a.layers.size(), b.layers.size());
    for (std::size_t k = 0; k < a.layers.size(); ++k) expect_equal(a.layers[k], b.layers[k]);
}

TEST(ResultFile, RoundTripsEverything) {
    const TemporaryFolder folder;
    for (unsigned seed = 0; seed < 20; ++seed) {
        const Measurement m = small_measurement(seed, static_cast<int>(seed % 4));
        save_measurement(m, folder / "r.asperity");
        EXPECT_TRUE(looks_like_result(folder / "r.asperity"));
        const Measurement read = load_measurement(folder / "r.asperity");
        expect_equal(read, m);
        EXPECT_TRUE(std::isnan(read.surface.kurtosis));
        EXPECT_EQ(checksum(read), checksum(m));
    }
    EXPECT_EQ(folder.files(), 1);
}

TEST(ResultFile, KeepsWhatTheErrorsComeFrom) {
    const TemporaryFolder folder;
    std::mt19937_64 engine(5);
    for (const bool stretched : {false, true}) {
        Measurement m = small_measurement();
        for (Layer& layer : m.layers) add_spread(m, layer, stretched, engine);
        m.part = 2, m.parts = 7, m.surface_digest = "abc", m.surface_cells = 12345;
        save_measurement(m, folder / "r.asperity");
        const Measurement read = load_measurement(folder / "r.asperity");
        expect_equal(read, m);
        for (std::size_t k = 0; k < m.layers.size(); ++k) {
            const LayerSpread &a = m.layers[k].spread, &b = read.layers[k].spread;
            EXPECT_EQ(a.largest_batch, b.largest_batch);
            EXPECT_TRUE(a.done == b.done && a.squares == b.squares && a.stretched == b.stretched &&
                        a.bounces == b.bounces && a.albedo == b.albedo && a.exact == b.exact &&
                        a.reached == b.reached && a.albedo_by_age == b.albedo_by_age &&
                        a.groups == b.groups && a.halves == b.halves);
        }
        EXPECT_EQ(std::tie(read.part, read.parts, read.surface_digest, read.surface_cells),
                  std::tie(m.part, m.parts, m.surface_digest, m.surface_cells));
        // The checksum is that of the result, with or without
        EXPECT_EQ(checksum(read), checksum(small_measurement()));
    }
}

TEST(ResultFile, LobesAreAllButWhatErrorsOfSeveralCellsComeFrom) {
    const TemporaryFolder folder;
    std::mt19937_64 engine(6);
    Measurement m = small_measurement();
    for (const bool with_spread : {false, true}) {
        if (with_spread)
            for (Layer& layer : m.layers) add_spread(m, layer, true, engine);
        const std::string sum = save_measurement(m, folder / "r.asperity");
        const ResultHead lobes = load_lobes(folder / "r.asperity");
        expect_equal(lobes.measurement, m);
        EXPECT_EQ(lobes.checksum, sum);
        for (std::size_t k = 0; k < m.layers.size(); ++k) {
            const LayerSpread& spread = lobes.measurement.layers[k].spread;
            EXPECT_TRUE(spread.squares == m.layers[k].spread.squares);
            EXPECT_TRUE(spread.groups == GroupSums());
        }
    }
}

// A file of format 1, as older versions wrote it.
TEST(ResultFile, OpensFilesOfTheFirstFormat) {
    const TemporaryFolder folder;
    const Measurement m = small_measurement();
    const ResultFields fields(m);
    const std::uint32_t first = 1;
    const std::string provenance =
        R"({"version": "0.1.0", "threads": 3, "trace_seconds": 0.1, "stopped": true, "notes": )"
        R"(["One.", "Two, with a \\."]})";
    std::vector<TensorBlock> blocks;
    std::vector<Digest> digests;
    for (const TensorBlock& block : fields.blocks()) {
        TensorBlock old = block;
        if (block.name == "format") old.parts = {std::as_bytes(std::span(&first, 1))};
        if (block.name == "provenance")
            old = {"provenance",
                   TensorType::U8,
                   {provenance.size()},
                   {std::as_bytes(std::span(provenance))}};
        if (!in_checksum(block.name) && block.name != "provenance") continue;
        if (block.name == "field_checksums" || block.name == "checksum") continue;
        blocks.push_back(old);
        digests.push_back(digest_of(old));
    }
    const std::string sum = checksum_of(std::span(digests).first(digests.size() - 1));
    blocks.push_back({"field_checksums",
                      TensorType::U64,
                      {digests.size(), 2},
                      {std::as_bytes(std::span(digests))}});
    blocks.push_back({"checksum", TensorType::U8, {32}, {std::as_bytes(std::span(sum))}});
    write_tensor_file(folder / "r.asperity", blocks);
    const Measurement read = load_measurement(folder / "r.asperity");
    expect_equal(read, m);
    EXPECT_EQ(sum, checksum(m));
    EXPECT_TRUE(read.layers[0].spread.squares.empty());
}

TEST(ResultFile, ChecksumKnowsTheResultAndNotTheRun) {
    const Measurement m = small_measurement();
    const std::string expected = checksum(m);
    EXPECT_EQ(expected.size(), 32u);
    Measurement other = m;
    other.threads = 7, other.trace_seconds = 9, other.version = "2", other.notes = {"x"};
    EXPECT_EQ(checksum(other), expected);

    const auto differs = [&](const char* what, auto&& change) {
        Measurement changed = m;
        change(changed);
        EXPECT_NE(checksum(changed), expected) << what;
    };
    differs("seed", [](Measurement& x) { x.experiment.run.seed = 2; });
    differs("surface", [](Measurement& x) { x.surface.max_tilt_deg = 1; });
    differs("channel", [](Measurement& x) { x.channel_names[0] = "X"; });
    differs("energy", [](Measurement& x) { ++x.layers[1].energy.back(); });
    differs("absorbed", [](Measurement& x) { ++x.layers[0].absorbed[0]; });
    differs("error", [](Measurement& x) { x.layers[0].stderr_energy[0] += 0.5f; });
    differs("angle", [](Measurement& x) { x.layers[0].theta_i += 1e-15; });
}

// The field "checksum" of a file is checksum() of the measurement.
TEST(ResultFile, KeepsTheChecksumInTheFile) {
    const TemporaryFolder folder;
    save_measurement(small_measurement(), folder / "r.asperity");
    const TensorFile file(folder / "r.asperity");
    std::string stored(32, ' ');
    file.read(file.require("checksum", TensorType::U8, 1), 0,
              std::as_writable_bytes(std::span(stored)));
    EXPECT_EQ(stored, checksum(small_measurement()));
}

TEST(ResultFile, RefusesEveryFlippedByte) {
    const TemporaryFolder folder;
    const std::string path = folder / "r.asperity";
    save_measurement(small_measurement(), path);
    const std::string good = get(path);
    std::fstream file(path, std::ios::binary | std::ios::in | std::ios::out);
    const auto write_byte = [&](std::size_t place, char byte) {
        file.seekp(static_cast<std::streamoff>(place));
        file.put(byte).flush();
    };
    for (std::size_t place = 0; place < good.size(); ++place) {
        // All bits of one byte, then one bit of the next, in turn.
        const int bits = place % 2 == 0 ? 0xff : 1 << (place / 2 % 8);
        write_byte(place, static_cast<char>(good[place] ^ bits));
        const auto error = error_of([&] { load_measurement(path); });
        const auto of_head = error_of([&] { load_head(path); });
        const auto of_lobes = error_of([&] { load_lobes(path); });
        write_byte(place, good[place]);
        ASSERT_TRUE(error && of_head && of_lobes) << "byte " << place << " of " << good.size();
        EXPECT_EQ(error->code(), ErrorCode::InvalidInput) << error->what();
        EXPECT_NE(std::string(error->what()).find("r.asperity: offset "), std::string::npos)
            << error->what();
    }
    EXPECT_NO_THROW(load_measurement(path));
}

// Large fields are packed, and every bit of them counts all the same.
TEST(ResultFile, PackedFieldsAreCheckedAsTheyAreStored) {
    const TemporaryFolder folder;
    const std::string path = folder / "r.asperity";
    std::mt19937_64 engine(2);
    Measurement m = small_measurement(1, 0);
    m.experiment.detector.resolution = 64;
    m.detector = Detector(m.experiment.detector);
    m.experiment.illumination.theta_deg = {10, 20, 30};
    for (const Incidence& light : incidences(m.experiment.illumination)) {
        m.layers.push_back(random_layer(m, light, engine));
        // As few cells as most results have
        Layer& layer = m.layers.back();
        for (std::size_t n = 0; n < layer.energy.size(); ++n) {
            if (n % 16 == 0) continue;
            layer.energy[n - n % 16] += layer.energy[n];
            layer.energy[n] = 0;
        }
    }
    save_measurement(m, path);
    const TensorFile file(path);
    const TensorField& energy = file.require("energy", TensorType::U64, 5);
    ASSERT_TRUE(energy.packed);
    EXPECT_LT(energy.stored, energy.bytes / 2);
    expect_equal(load_measurement(path), m);
    const std::string good = get(path);
    for (std::uint64_t k = 0; k < 400; ++k) {
        // The heads first
        const std::uint64_t place = energy.offset + (k < 64 ? k : engine() % energy.stored);
        std::string bad = good;
        bad[static_cast<std::size_t>(place)] ^= static_cast<char>(1 << engine() % 8);
        put(path, bad);
        const auto error = error_of([&] { load_measurement(path); });
        ASSERT_TRUE(error) << "byte " << place;
        EXPECT_EQ(error->code(), ErrorCode::InvalidInput) << error->what();
    }
}

TEST(ResultFile, RefusesEveryCutAndEveryTail) {
    const TemporaryFolder folder;
    const std::string path = folder / "r.asperity";
    save_measurement(small_measurement(), path);
    const std::string good = get(path);
    put(path, good + std::string(1, '\0'));
    expect_error(ErrorCode::InvalidInput, "1 bytes follow the last field",
                 [&] { load_measurement(path); });
    put(path, good);
    test::with_each_cut(path, [&](std::uintmax_t length) {
        const auto error = error_of([&] { load_measurement(path); });
        ASSERT_TRUE(error) << length << " bytes";
        EXPECT_EQ(error->code(), ErrorCode::InvalidInput) << error->what();
    });
}

TEST(ResultFile, NamesTheDamagedField) {
    const TemporaryFolder folder;
    save_measurement(small_measurement(), folder / "r.asperity");
    const std::uint64_t offset =
        TensorFile(folder / "r.asperity").require("energy", TensorType::U64, 5).offset;
    std::string bad = get(folder / "r.asperity");
    ++bad[static_cast<std::size_t>(offset) + 9];
    put(folder / "r.asperity", bad);
    expect_error(ErrorCode::InvalidInput,
                 "r.asperity: offset " + std::to_string(offset) + ": field 'energy' is damaged",
                 [&] { load_measurement(folder / "r.asperity"); });
}

TEST(ResultFile, RefusesToSaveAContradiction) {
    const TemporaryFolder folder;
    const auto refused = [&](const std::string& why, auto&& change) {
        Measurement m = small_measurement();
        change(m);
        expect_error(ErrorCode::InvalidInput, why,
                     [&] { save_measurement(m, folder / "r.asperity"); });
        EXPECT_EQ(folder.files(), 0);
    };
    refused("channel R: launched energy is not", [](Measurement& m) { ++m.layers[0].edge[0]; });
    refused("channel G: escaped energy is not the sum over the cells",
            [](Measurement& m) { --m.layers[0].escaped[1], ++m.layers[0].absorbed[1]; });
    refused("the sum over the bounces", [](Measurement& m) {
        ++m.layers[0].escaped_by_bounce[0], --m.layers[0].energy[0], --m.layers[0].escaped[0],
            ++m.layers[0].absorbed[0];
    });
    // Sums that only fit because they wrap around 2^64.
    refused("launched energy is not", [](Measurement& m) {
        m.layers[0].absorbed[0] += std::uint64_t{1} << 63;
        m.layers[0].edge[0] += std::uint64_t{1} << 63;
    });
    refused("wrong size", [](Measurement& m) { m.layers[1].energy.pop_back(); });
    refused("wrong size", [](Measurement& m) { m.layers[1].stderr_albedo.clear(); });
    refused("0 channels", [](Measurement& m) { m.channel_names.clear(); });
    refused("detector", [](Measurement& m) { m.experiment.detector.resolution = 8; });
    refused("no incident direction", [](Measurement& m) { m.layers[0].theta_i = -1; });
    refused("the experiment has no such light", [](Measurement& m) { m.layers[0].theta_i = 1; });
}

// Files with right checksums whose content is wrong all the same.
TEST(ResultFile, RefusesWellFormedNonsense) {
    const TemporaryFolder folder;
    const Measurement m = small_measurement();
    const auto refused = [&](const std::string& name, std::string content, TensorType type,
                             std::vector<std::uint64_t> shape, const std::string& why) {
        const ResultFields fields(m);
        std::vector<TensorBlock> blocks(fields.blocks().begin(), fields.blocks().end() - 2);
        for (TensorBlock& block : blocks)
            if (block.name == name)
                block = {name, type, shape, {std::as_bytes(std::span(content))}};
        std::vector<Digest> digests, counted;
        for (const TensorBlock& block : blocks) {
            digests.push_back(digest_of(block));
            if (in_checksum(block.name))
                counted.push_back(block.name == "format" ? format_digest() : digests.back());
        }
        const std::string sum = checksum_of(counted);
        blocks.push_back({"checksum", TensorType::U8, {32}, {std::as_bytes(std::span(sum))}});
        digests.push_back(digest_of(blocks.back()));
        blocks.push_back({"field_checksums",
                          TensorType::U64,
                          {digests.size(), 2},
                          {std::as_bytes(std::span(digests))}});
        write_tensor_file(folder / "r.asperity", blocks);
        expect_error(ErrorCode::InvalidInput, why,
                     [&] { load_measurement(folder / "r.asperity"); });
    };
    const auto text = [&](const std::string& name, const std::string& content,
                          const std::string& why) {
        refused(name, content, TensorType::U8, {content.size()}, why);
    };
    text("experiment", "size = 1\n", "field 'experiment': line:1: size: '1' must be in 2");
    text("experiment", "resolution = 8192\n", "'theta_edges' does not have the shape");
    text("experiment", "phi = none\n", "field 'experiment': phi: needs at least one azimuth");
    text("channel_names", "[\"R\"", "field 'channel_names': [json");
    text("channel_names", "{\"R\": 1}", "field 'channel_names': [json");
    text("channel_names", "[\"R\"]", "'escaped' does not have the shape");
    text("channel_names", std::string(100000, '['), "field 'channel_names': [json");
    text("surface", "[]", "field 'surface': [json");
    text("surface", "null", "field 'surface': [json");
    text("provenance", "{\"version\": 1}", "field 'provenance': [json");
    refused("theta_i", std::string(8, '\0'), TensorType::F64, {1}, "does not have the shape");
    refused("theta_i", std::string(16, '\xff'), TensorType::F64, {2}, "no incident direction");
    refused("rays", std::string(16, '\0'), TensorType::U64, {2}, "launched energy is not");
    refused("rays", std::string(16, '\xff'), TensorType::U64, {2}, "rays are too many");
    refused("rays", std::string(16, '\0'), TensorType::I64, {2}, "another type");
    refused("phi_i", std::string(16, '\0'), TensorType::F64, {2}, "has no such light");
    refused("batches", std::string(8, '\xff'), TensorType::I32, {2}, "layer 2: -1 batches");
    refused("stuck", std::string(16, '\xff'), TensorType::U64, {2}, "rays stuck");
    refused("stderr_albedo", std::string(48, '\xff'), TensorType::F64, {2, 3}, "is negative or no");
    refused("theta_edges", std::string(24, '\xff'), TensorType::F64, {3}, "does not fit the");
    refused("format", std::string("\5\0\0\0", 4), TensorType::U32, {1}, "format 5 is not known");
    refused("sides", std::string("\2\0\0\0", 4), TensorType::U32, {1}, "more sides than one");
    refused("elements", std::string("\0\0\0\0", 4), TensorType::U32, {1}, "more elements");
    refused("format", std::string("\0\0\0\0", 4), TensorType::U32, {1}, "format 0 is not known");
}

TEST(ResultFile, RefusesWhatIsNoResult) {
    const TemporaryFolder folder;
    put(folder / "text", "Hello, this is not a result file at all");
    put(folder / "empty", "");
    write_tensor_file(folder / "foreign", {});
    const auto refused = [&](const std::string& name, ErrorCode code, const std::string& why) {
        expect_error(code, name + ": " + why, [&] { load_measurement(folder / name); });
    };
    refused("text", ErrorCode::InvalidInput, "offset 0: not a tensor file (wrong magic)");
    refused("empty", ErrorCode::InvalidInput, "offset 0: the file ends inside its magic");
    refused("foreign", ErrorCode::InvalidInput,
            "offset 0: a tensor file, but no result of Asperity");
    refused("none", ErrorCode::InputOutput, "cannot open: No such file or directory");
    refused("", ErrorCode::InputOutput, "cannot read: it is a folder");
    EXPECT_FALSE(looks_like_result(folder / "text"));
}

TEST(ResultFile, AFullDiskIsReported) {
    if (!test::has_full_device()) GTEST_SKIP() << "no /dev/full here";
    expect_error(ErrorCode::InputOutput, "/dev/full: cannot write: No space left on device",
                 [] { save_measurement(small_measurement(), "/dev/full"); });
}

}  // namespace
}  // namespace asperity::io
