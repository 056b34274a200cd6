// SPDX-License-Identifier: Apache-2.0
#include <asperity/core/random.h>
#include <asperity/render/sampler.h>

namespace asperity {

namespace {

/// The stream of CounterRandom for pictures.
constexpr std::uint32_t kPictureStream = 0x70696374;

std::uint32_t reverse_bits(std::uint32_t x) {
    x = ((x >> 1) & 0x55555555u) | ((x & 0x55555555u) << 1);
    x = ((x >> 2) & 0x33333333u) | ((x & 0x33333333u) << 2);
    x = ((x >> 4) & 0x0f0f0f0fu) | ((x & 0x0f0f0f0fu) << 4);
    return __builtin_bswap32(x);
}

/// Mixes a word well (Wellons 2018, "Prospecting for hash functions", lowbias32).
std::uint32_t mix(std::uint32_t x) {
    x ^= x >> 16;
    x *= 0x7feb352du;
    x ^= x >> 15;
    x *= 0x846ca68bu;
    return x ^ (x >> 16);
}

/// A permutation in which each bit depends on the lower ones only: Owen's scrambling, seen from the
/// last bit (Laine and Karras 2011; the constants of Vegdahl 2021, "Building a better LK hash").
std::uint32_t scramble_upwards(std::uint32_t x, std::uint32_t seed) {
    x ^= x * 0x3d20adeau;
    x += seed;
    x *= (seed >> 16) | 1u;
    x ^= x * 0x05526c56u;
    x ^= x * 0x53a22864u;
    return x;
}

/// The second Sobol dimension, reversed: Pascal's triangle modulo 2 times the bits of the index.
/// By Lucas' theorem bit i is the sum of all bits j whose number j contains that of i.
std::uint32_t second_dimension(std::uint32_t x) {
    x ^= (x & 0xaaaaaaaau) >> 1;
    x ^= (x & 0xccccccccu) >> 2;
    x ^= (x & 0xf0f0f0f0u) >> 4;
    x ^= (x & 0xff00ff00u) >> 8;
    return x ^ (x >> 16);
}

double to_unit(std::uint32_t x) {
    return x * 0x1p-32;
}

}  // namespace

PixelSampler::PixelSampler(std::uint64_t seed, std::uint32_t pixel, std::uint32_t sample)
    : key_(CounterRandom(seed, kPictureStream).bits(pixel)), sample_(reverse_bits(sample)) {}

std::array<double, 2> PixelSampler::next2() {
    const std::uint32_t salt = ++dimension_ * 0x9e3779b9u;
    const std::uint32_t index = reverse_bits(scramble_upwards(sample_, mix(key_[0] ^ salt)));
    const std::uint32_t x = scramble_upwards(index, mix(key_[1] ^ salt));
    const std::uint32_t y = scramble_upwards(second_dimension(index), mix(key_[2] ^ salt));
    return {to_unit(reverse_bits(x)), to_unit(reverse_bits(y))};
}

}  // namespace asperity
