// SPDX-License-Identifier: Apache-2.0
// Thesis 3.2: the hemisphere cut into strata over theta and phi, a random place in each.
#include <asperity/core/random.h>
#include <asperity/render/wave.h>

#include <bit>

namespace asperity {

namespace {

/// The stream of CounterRandom for the order of the strata.
constexpr std::uint32_t kStrataStream = 0x73747261;

/// Where `index` comes in a random order of `count` things; `key` is the order. Steps that can be
/// undone mix the numbers below the next power of two, until one of those that are meant comes up.
std::uint32_t in_random_order(std::uint32_t index, std::uint32_t count,
                              const std::array<std::uint32_t, 4>& key) {
    const std::uint32_t mask = std::bit_ceil(count) - 1;
    const int half = (std::bit_width(mask) + 1) / 2;
    do {
        for (const std::uint32_t k : key) {
            index = ((index ^ k) * (2 * (k >> 8) + 1)) & mask;
            index ^= index >> half;
        }
    } while (index >= count);
    return index;
}

/// Radiance of all lights with an extent from one direction.
Rgb light_from(const View& view, Vec3 direction) {
    Rgb sum;
    for (const LightChoice::Chance& chance : view.lights.extended())
        sum = sum + chance.light->radiance(direction);
    return sum;
}

}  // namespace

void trace_strata(Wave& wave, std::span<const std::uint32_t> pixels, std::uint32_t sample) {
    const View& view = wave.view();
    const auto side = static_cast<std::uint32_t>(view.settings.strata);
    const std::uint32_t cells = side * side;
    const CounterRandom random(view.settings.seed, kStrataStream);
    const std::vector<Hit> hits = wave.camera_hits();

    for (std::size_t k = 0; k < hits.size(); ++k) {
        Path& path = wave.paths()[k];
        if (!hits[k].found()) {
            path.radiance = wave.background(path.ray.direction);
            continue;
        }
        const Vertex vertex = wave.vertex(path, hits[k]);
        wave.ask_lights(k, vertex, true);
        if (view.lights.extended().empty()) continue;

        // A random place in this sample's cell
        const std::uint32_t cell =
            in_random_order(sample % cells, cells, random.bits(pixels[k], sample / cells));
        const auto u = path.sampler.next2();
        const double theta = (cell / side + u[0]) / side * (0.5 * kPi);
        const double phi = (cell % side + u[1]) / side * (2 * kPi);

        // f L cos(theta) dw, dw = sin(theta) dtheta dphi, over pi / 2 times 2 pi
        const Vec3 local = from_spherical(theta, phi);
        const Vec3 direction = vertex.frame.to_world(local);
        const double weight = vertex.cosine(direction, local) * std::sin(theta) * kPi * kPi;
        if (weight <= 0) continue;
        const Rgb found =
            weight * (vertex.material->eval(vertex.view, local) * light_from(view, direction));
        if (!is_black(found)) wave.add_unless_hidden(k, vertex.ray_to(direction), found);
    }
    wave.trace_shadow_rays();
}

}  // namespace asperity
