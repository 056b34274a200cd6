// SPDX-License-Identifier: Apache-2.0
#include <asperity/core/directions.h>
#include <asperity/core/error.h>
#include <asperity/core/parse_number.h>
#include <asperity/formats/bsdfs/tensor_tree.h>

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace asperity::io {
namespace {

constexpr int kMostDepth = 16;

std::size_t power_of_two(int exponent) {
    return std::size_t{1} << exponent;
}

}  // namespace

SquarePoint disk_to_square(double x, double y) {
    const double r = std::min(1.0, std::hypot(x, y));
    double phi = std::atan2(y, x);
    if (phi < -kPi / 4) phi += 2 * kPi;
    // Four sectors about the axes; (a, b) in -1 .. 1.
    const int sector = std::min(3, static_cast<int>((phi + kPi / 4) / (kPi / 2)));
    const double along = (phi - sector * kPi / 2) / (kPi / 4) * r;
    const std::array<std::array<double, 2>, 4> places = {
        {{r, along}, {-along, r}, {-r, -along}, {along, -r}}};
    const auto& [a, b] = places[static_cast<std::size_t>(sector)];
    return {0.5 * (a + 1), 0.5 * (b + 1)};
}

Vec3 hemisphere_of_square(SquarePoint s) {
    const double a = 2 * s.u - 1, b = 2 * s.v - 1;
    if (a == 0 && b == 0) return {0, 0, 1};
    double r = a, phi = kPi / 4 * b / a;  // |a| > |b|; a negative r turns by pi
    if (std::abs(b) > std::abs(a)) {
        r = b;
        phi = kPi / 2 - kPi / 4 * a / b;
    }
    return {r * std::cos(phi), r * std::sin(phi), std::sqrt(std::max(0.0, 1 - r * r))};
}

std::array<double, 4> tree_coordinates(int rank, Vec3 wi, Vec3 wo) {
    if (rank == 4) {
        const SquarePoint in = disk_to_square(-wi.x, -wi.y), out = disk_to_square(wo.x, wo.y);
        return {in.u, in.v, out.u, out.v};
    }
    const Vec3 turned = rotate_z(wo, -azimuth({-wi.x, -wi.y, wi.z}));
    const SquarePoint out = disk_to_square(turned.x, turned.y);
    // Light along the normal belongs to the lower half, as in Radiance.
    return {std::min(0.5 * (1 - std::hypot(wi.x, wi.y)), 0.5 - 1e-6), out.u, out.v, 0};
}

TreeDirections tree_directions(int rank, const std::array<double, 4>& c) {
    if (rank == 4) {
        const Vec3 in = hemisphere_of_square({c[0], c[1]});
        return {{-in.x, -in.y, in.z}, hemisphere_of_square({c[2], c[3]})};
    }
    const double s = std::clamp(1 - 2 * c[0], 0.0, 1.0);
    return {{-s, 0, std::sqrt(1 - s * s)}, hemisphere_of_square({c[1], c[2]})};
}

TensorTree::TensorTree(int rank, int levels, const std::vector<double>& grid, double tolerance,
                       std::function<void()> between)
    : rank_(rank) {
    root_ = build(levels, grid, levels, {}, tolerance, between);
}

std::size_t TensorTree::build(int levels, const std::vector<double>& grid, int grid_levels,
                              std::array<std::size_t, 4> corner, double tolerance,
                              const std::function<void()>& between) {
    if (between) between();
    Node node;
    const std::size_t side = power_of_two(levels), count = power_of_two(levels * rank_);
    for (std::size_t k = 0; k < count; ++k) {
        std::size_t index = 0;
        for (int d = 0; d < rank_; ++d) {
            const std::size_t within = (k >> ((rank_ - 1 - d) * levels)) & (side - 1);
            index = (index << grid_levels) + corner[static_cast<std::size_t>(d)] + within;
        }
        node.values.push_back(grid[index]);
    }
    const auto [least, most] = std::minmax_element(node.values.begin(), node.values.end());
    if (*most - *least <= tolerance * *most) {
        double mean = 0;
        for (const double value : node.values) mean += value / static_cast<double>(count);
        node.values = {mean};
        node.levels = 0;
    } else if (levels == 1) {
        node.levels = 1;
    } else {
        node.values.clear();
        for (std::size_t child = 0; child < power_of_two(rank_); ++child) {
            std::array<std::size_t, 4> at = corner;
            for (std::size_t d = 0; d < static_cast<std::size_t>(rank_); ++d)
                if (child >> d & 1) at[d] += side / 2;
            node.branch.push_back(build(levels - 1, grid, grid_levels, at, tolerance, between));
        }
    }
    nodes_.push_back(std::move(node));
    return nodes_.size() - 1;
}

TensorTree::TensorTree(int rank, std::string_view text, const std::string& where) : rank_(rank) {
    std::size_t at = 0;
    root_ = parse(text, at, 0, where);
    if (!trimmed(text.substr(at)).empty())
        throw Error(ErrorCode::InvalidInput, "has more behind the last brace", where);
}

std::size_t TensorTree::parse(std::string_view text, std::size_t& at, int depth,
                              const std::string& where) {
    const auto fail = [&](const std::string& why) {
        throw Error(ErrorCode::InvalidInput, "tensor tree: " + why, where);
    };
    const auto next = [&] {
        at = text.find_first_not_of(" \t\r\n,", at);
        if (at == text.npos) fail("a brace is missing");
        return text[at];
    };
    if (next() != '{') fail("a brace is missing");
    if (depth > kMostDepth) fail("it is too deep");
    ++at;
    Node node;
    while (next() != '}') {
        if (text[at] == '{') {
            node.branch.push_back(parse(text, at, depth + 1, where));
            continue;
        }
        const std::size_t end = std::min(text.find_first_of(" \t\r\n,{}", at), text.size());
        const auto value = parse_double(text.substr(at, end - at));
        if (!value) fail(in_quotes(text.substr(at, end - at)) + " is no number");
        node.values.push_back(std::max(0.0, *value));
        at = end;
    }
    ++at;
    if (!node.branch.empty()) {
        if (!node.values.empty() || node.branch.size() != power_of_two(rank_))
            fail(fmt::format("a branch has {} children and {} values", node.branch.size(),
                             node.values.size()));
    } else {
        node.levels = 0;
        while (power_of_two(node.levels * rank_) < node.values.size()) ++node.levels;
        if (power_of_two(node.levels * rank_) != node.values.size())
            fail(fmt::format("a leaf has {} values", node.values.size()));
    }
    nodes_.push_back(std::move(node));
    return nodes_.size() - 1;
}

double TensorTree::at(const std::array<double, 4>& coordinates) const {
    std::array<double, 4> c = coordinates;
    for (double& x : c) x = std::clamp(x, 0.0, 1 - 1e-12);
    const Node* node = &nodes_[root_];
    while (node->levels < 0) {
        std::size_t child = 0;
        for (std::size_t d = 0; d < static_cast<std::size_t>(rank_); ++d) {
            c[d] *= 2;
            if (c[d] >= 1) {
                child |= std::size_t{1} << d;
                c[d] -= 1;
            }
        }
        node = &nodes_[node->branch[child]];
    }
    std::size_t index = 0;
    for (std::size_t d = 0; d < static_cast<std::size_t>(rank_); ++d)
        index = (index << node->levels) +
                static_cast<std::size_t>(c[d] * static_cast<double>(power_of_two(node->levels)));
    return node->values[index];
}

void TensorTree::append_text(std::size_t index, std::string& text,
                             const std::function<void()>& between) const {
    if (between) between();
    const Node& node = nodes_[index];
    text += '{';
    for (const std::size_t child : node.branch) append_text(child, text, between);
    for (const double value : node.values) text += fmt::format(" {:.5g}", value);
    text += node.branch.empty() ? " }\n" : "}\n";
}

std::string TensorTree::text(const std::function<void()>& between) const {
    std::string text;
    append_text(root_, text, between);
    return text;
}

}  // namespace asperity::io
