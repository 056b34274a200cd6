// SPDX-License-Identifier: Apache-2.0
#include <asperity/formats/bsdfs/rgl_warp.h>

namespace asperity::io::rgl {
namespace {

struct Bracket {
    std::size_t index = 0, next = 0;
    double t = 0;
};

Bracket bracket(std::span<const float> nodes, double x) {
    const std::size_t last = nodes.size() - 1;
    if (!(x > double{nodes.front()})) return {0, 0, 0};
    if (x >= double{nodes.back()}) return {last, last, 0};
    std::size_t k = 0;
    while (k + 2 < nodes.size() && double{nodes[k + 1]} <= x) ++k;
    const double low = double{nodes[k]}, high = double{nodes[k + 1]};
    return {k, k + 1, (x - low) / (high - low)};
}

/// The patch that holds a coordinate of the square, and where in it.
struct Cell {
    std::size_t index = 0;
    double t = 0;
};

Cell cell_at(double x, std::size_t nodes) {
    const double scaled = std::clamp(x, 0.0, 1.0) * static_cast<double>(nodes - 1);
    const std::size_t index = std::min(static_cast<std::size_t>(scaled), nodes - 2);
    return {index, scaled - static_cast<double>(index)};
}

/// Where a linear density a at 0, b at 1 has gathered `mass`, in [0, 1].
double invert_linear(double a, double b, double mass) {
    double x;
    if (std::abs(a - b) < 1e-4 * (a + b)) {
        x = a + b > 0 ? 2 * mass / (a + b) : 0.5;
    } else {
        x = (a - std::sqrt(std::max(0.0, a * a - 2 * mass * (a - b)))) / (a - b);
    }
    return std::clamp(x, 0.0, 1.0);
}

}  // namespace

Blend blend_at(std::span<const float> phis, std::span<const float> thetas, double phi,
               double theta) {
    const Bracket p = phis.size() == 1 ? Bracket{} : bracket(phis, phi), t = bracket(thetas, theta);
    const std::size_t n = thetas.size();
    return {
        {p.index * n + t.index, p.index * n + t.next, p.next * n + t.index, p.next * n + t.next},
        {(1 - p.t) * (1 - t.t), (1 - p.t) * t.t, p.t * (1 - t.t), p.t * t.t}};
}

double Images::eval(Point u, const Blend& blend) const {
    const Cell x = cell_at(u.x, width), y = cell_at(u.y, height);
    double sum = 0;
    for (std::size_t k = 0; k < 4; ++k) {
        if (blend.weight[k] == 0) continue;
        const float* v = &values[(blend.slice[k] * height + y.index) * width + x.index];
        const double low = (1 - x.t) * double{v[0]} + x.t * double{v[1]};
        const double high = (1 - x.t) * double{v[width]} + x.t * double{v[width + 1]};
        sum += blend.weight[k] * ((1 - y.t) * low + y.t * high);
    }
    return sum;
}

Density::Density(Images images, const std::function<void()>& before_slice)
    : width_(images.width), height_(images.height) {
    const std::size_t size = width_ * height_, slices = images.values.size() / size;
    values_.assign(images.values.begin(), images.values.end());
    columns_.resize(values_.size());
    rows_.resize(slices * height_);
    for (std::size_t s = 0; s < slices; ++s) {
        if (before_slice) before_slice();
        double* values = &values_[s * size];
        double* columns = &columns_[s * size];
        double* rows = &rows_[s * height_];
        for (std::size_t r = 0; r < height_; ++r)
            for (std::size_t c = 1; c < width_; ++c)
                columns[r * width_ + c] =
                    columns[r * width_ + c - 1] +
                    0.5 * (values[r * width_ + c - 1] + values[r * width_ + c]);
        for (std::size_t r = 1; r < height_; ++r)
            rows[r] = rows[r - 1] + 0.5 * (columns[r * width_ - 1] + columns[(r + 1) * width_ - 1]);
        const double scale = 1 / rows[height_ - 1];
        for (std::size_t k = 0; k < size; ++k) {
            values[k] *= scale;
            columns[k] *= scale;
        }
        for (std::size_t r = 0; r < height_; ++r) rows[r] *= scale;
    }
}

double Density::at(const std::vector<double>& table, std::size_t slice_size, std::size_t index,
                   const Blend& blend) const {
    double sum = 0;
    for (std::size_t k = 0; k < 4; ++k)
        if (blend.weight[k] != 0)
            sum += blend.weight[k] * table[blend.slice[k] * slice_size + index];
    return sum;
}

Density::Warped Density::sample(Point s, const Blend& blend) const {
    const std::size_t size = width_ * height_;
    const auto row_mass = [&](std::size_t r) { return at(rows_, height_, r, blend); };
    std::size_t low = 0, high = height_ - 1;  // the row: the last that begins at or below s.y
    while (high - low > 1) {
        const std::size_t middle = (low + high) / 2;
        (row_mass(middle) <= s.y ? low : high) = middle;
    }
    const std::size_t row = low;
    const auto end = [&](std::size_t r) { return at(columns_, size, (r + 1) * width_ - 1, blend); };
    const double r0 = end(row), r1 = end(row + 1);
    const double y = invert_linear(r0, r1, std::max(0.0, s.y - row_mass(row)));

    const auto gathered = [&](std::size_t c) {
        return (1 - y) * at(columns_, size, row * width_ + c, blend) +
               y * at(columns_, size, (row + 1) * width_ + c, blend);
    };
    const double mass = s.x * ((1 - y) * r0 + y * r1);
    low = 0;
    high = width_ - 1;
    while (high - low > 1) {
        const std::size_t middle = (low + high) / 2;
        (gathered(middle) <= mass ? low : high) = middle;
    }
    const auto value = [&](std::size_t c) {
        return (1 - y) * at(values_, size, row * width_ + c, blend) +
               y * at(values_, size, (row + 1) * width_ + c, blend);
    };
    const double c0 = value(low), c1 = value(low + 1);
    const double x = invert_linear(c0, c1, std::max(0.0, mass - gathered(low)));
    const double w = static_cast<double>(width_ - 1), h = static_cast<double>(height_ - 1);
    return {{(static_cast<double>(low) + x) / w, (static_cast<double>(row) + y) / h},
            ((1 - x) * c0 + x * c1) * w * h};
}

Density::Warped Density::invert(Point u, const Blend& blend) const {
    const std::size_t size = width_ * height_;
    const Cell x = cell_at(u.x, width_), y = cell_at(u.y, height_);
    const std::size_t k = y.index * width_ + x.index;
    const auto mix = [&](const std::vector<double>& table, std::size_t index) {
        return (1 - y.t) * at(table, size, index, blend) +
               y.t * at(table, size, index + width_, blend);
    };
    const double c0 = mix(values_, k), c1 = mix(values_, k + 1);
    const double r0 = at(columns_, size, (y.index + 1) * width_ - 1, blend);
    const double r1 = at(columns_, size, (y.index + 2) * width_ - 1, blend);
    const double along = x.t * (c0 + 0.5 * x.t * (c1 - c0)) + mix(columns_, k);
    const double whole = (1 - y.t) * r0 + y.t * r1;
    const double w = static_cast<double>(width_ - 1), h = static_cast<double>(height_ - 1);
    return {
        {whole > 0 ? std::min(1.0, along / whole) : 0.0,
         std::min(1.0, y.t * (r0 + 0.5 * y.t * (r1 - r0)) + at(rows_, height_, y.index, blend))},
        ((1 - x.t) * c0 + x.t * c1) * w * h};
}

double Density::eval(Point u, const Blend& blend) const {
    return invert(u, blend).density;
}

}  // namespace asperity::io::rgl
