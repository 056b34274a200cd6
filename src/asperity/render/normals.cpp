// SPDX-License-Identifier: Apache-2.0
// Normals of meshes: set_normals and drop_undrawable.
#include <asperity/core/directions.h>
#include <asperity/core/error.h>
#include <asperity/render/mesh.h>
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>
#include <numeric>
#include <tuple>
#include <vector>

namespace asperity {
namespace {

// A triangle is without area when twice its area is less than this share of its longest side
// squared: what rounding in double precision leaves of three points on a line.
constexpr double kNoArea = 1e-15;

using Triangle = std::array<std::uint32_t, 3>;

bool is_finite(Vec3f v) {
    return std::isfinite(v.x) && std::isfinite(v.y) && std::isfinite(v.z);
}

Vec3f to_float(Vec3 v) {
    return {static_cast<float>(v.x), static_cast<float>(v.y), static_cast<float>(v.z)};
}

/// The unit normal of a triangle; zero when it has no area or is not finite.
Vec3 facet_normal(const TriangleMesh& mesh, const Triangle& t) {
    const Vec3 p = to_double(mesh.positions[t[0]]);
    const Vec3 a = to_double(mesh.positions[t[1]]) - p, b = to_double(mesh.positions[t[2]]) - p;
    const Vec3 n = cross(a, b);
    const double longest = std::max({dot(a, a), dot(b, b), dot(b - a, b - a)});
    const double size = length(n);
    // Written so that a NaN is no area either.
    return size > kNoArea * longest && std::isfinite(size) ? (1 / size) * n : Vec3{};
}

/// Angle of a triangle at its corner k [rad].
double corner_angle(const TriangleMesh& mesh, const Triangle& t, std::size_t k) {
    const Vec3 p = to_double(mesh.positions[t[k]]);
    const Vec3 a = to_double(mesh.positions[t[(k + 1) % 3]]) - p;
    const Vec3 b = to_double(mesh.positions[t[(k + 2) % 3]]) - p;
    return std::atan2(length(cross(a, b)), dot(a, b));
}

/// For each vertex a number of the place at which it lies; equal for equal positions.
std::vector<std::uint32_t> places_of(const std::vector<Vec3f>& positions) {
    std::vector<std::uint32_t> order(positions.size());
    std::iota(order.begin(), order.end(), 0u);
    const auto key = [&](std::uint32_t v) {
        const Vec3f p = positions[v];
        return std::tuple(p.x, p.y, p.z);
    };
    // Those that are not finite have no order; each is a place of its own, at the end.
    const auto finite = std::stable_partition(
        order.begin(), order.end(), [&](std::uint32_t v) { return is_finite(positions[v]); });
    std::sort(order.begin(), finite, [&](std::uint32_t a, std::uint32_t b) {
        return std::tuple(key(a), a) < std::tuple(key(b), b);
    });
    std::vector<std::uint32_t> places(positions.size());
    std::uint32_t place = 0;
    for (auto it = order.begin(); it != order.end(); ++it) {
        if (it != order.begin() && (it >= finite || key(*it) != key(*(it - 1)))) ++place;
        places[*it] = place;
    }
    return places;
}

/// Groups that are joined two by two.
class Groups {
  public:
    explicit Groups(std::size_t count) : parent_(count) {
        std::iota(parent_.begin(), parent_.end(), 0u);
    }
    std::uint32_t find(std::uint32_t i) {
        while (parent_[i] != i) i = parent_[i] = parent_[parent_[i]];
        return i;
    }
    /// The smaller number stays: the outcome does not hang on the order of joins.
    void join(std::uint32_t a, std::uint32_t b) {
        a = find(a);
        b = find(b);
        parent_[std::max(a, b)] = std::min(a, b);
    }

  private:
    std::vector<std::uint32_t> parent_;
};

/// Smooth normals of one mesh. A corner is 3 * triangle + k; corners that share a normal make a
/// group.
class Smoother {
  public:
    Smoother(TriangleMesh& mesh, double crease_deg)
        : mesh_(mesh),
          crease_deg_(crease_deg),
          places_(places_of(mesh.positions)),
          groups_(3 * mesh.triangles.size()) {
        for (const Triangle& t : mesh.triangles) facets_.push_back(facet_normal(mesh, t));
    }

    void smooth() {
        if (crease_deg_ >= 180)
            join_all();
        else
            join_over_edges();
        sum_normals();
        give_normals();
    }

  private:
    std::uint32_t vertex(std::uint32_t corner) const {
        return mesh_.triangles[corner / 3][corner % 3];
    }
    std::uint32_t corners() const { return static_cast<std::uint32_t>(3 * facets_.size()); }

    /// Without an edge: all corners at one place are one group.
    void join_all() {
        std::vector<std::uint32_t> first(mesh_.positions.size(), corners());
        for (std::uint32_t c = 0; c < corners(); ++c) {
            std::uint32_t& leader = first[places_[vertex(c)]];
            if (leader == corners())
                leader = c;
            else
                groups_.join(leader, c);
        }
    }

    /// Two facets with a side in common that meet at `crease_deg` or less share both its ends.
    void join_over_edges() {
        struct Side {
            std::uint32_t low, high;                // places
            std::uint32_t low_corner, high_corner;  // of one facet there
        };
        std::vector<Side> sides;
        for (std::uint32_t t = 0; t < facets_.size(); ++t) {
            if (facets_[t] == Vec3{}) continue;
            for (std::uint32_t k = 0; k < 3; ++k) {
                const std::uint32_t a = 3 * t + k, b = 3 * t + (k + 1) % 3;
                const std::uint32_t pa = places_[vertex(a)], pb = places_[vertex(b)];
                sides.push_back(pa < pb ? Side{pa, pb, a, b} : Side{pb, pa, b, a});
            }
        }
        std::sort(sides.begin(), sides.end(), [](const Side& a, const Side& b) {
            return std::tie(a.low, a.high, a.low_corner) < std::tie(b.low, b.high, b.low_corner);
        });
        const double least = std::cos(radians(crease_deg_)) - 1e-9;
        for (std::size_t i = 1; i < sides.size(); ++i) {
            const Side &a = sides[i - 1], &b = sides[i];
            if (a.low != b.low || a.high != b.high) continue;
            if (dot(facets_[a.low_corner / 3], facets_[b.low_corner / 3]) < least) continue;
            groups_.join(a.low_corner, b.low_corner);
            groups_.join(a.high_corner, b.high_corner);
        }
    }

    void sum_normals() {
        sums_.assign(corners(), {});
        for (std::uint32_t c = 0; c < corners(); ++c) {
            const Vec3 facet = facets_[c / 3];
            if (facet == Vec3{}) continue;
            Vec3& sum = sums_[groups_.find(c)];
            sum = sum + corner_angle(mesh_, mesh_.triangles[c / 3], c % 3) * facet;
        }
    }

    /// Whether the group of a corner has a direction: facets that cancel leave rounding errors.
    bool has_direction(std::uint32_t group) const {
        constexpr double kNothing = 1e-9;
        return length(sums_[group]) > kNothing;
    }

    /// The corner by whose name it shares a normal: of its group, or its own.
    std::uint32_t shared(std::uint32_t corner) {
        const std::uint32_t group = groups_.find(corner);
        return has_direction(group) ? group : corner;
    }

    Vec3 normal(std::uint32_t shared_corner) const {
        if (has_direction(shared_corner)) return normalize(sums_[shared_corner]);
        const Vec3 facet = facets_[shared_corner / 3];
        return facet == Vec3{} ? Vec3{0, 1, 0} : facet;
    }

    /// Gives each vertex its normal, and doubles those that need several.
    void give_normals() {
        struct Use {
            std::uint32_t vertex, shared, corner;
            auto operator<=>(const Use&) const = default;
        };
        std::vector<Use> uses;
        uses.reserve(corners());
        for (std::uint32_t c = 0; c < corners(); ++c) uses.push_back({vertex(c), shared(c), c});
        std::sort(uses.begin(), uses.end());

        mesh_.normals.assign(mesh_.positions.size(), Vec3f{0, 1, 0});
        std::uint32_t current = 0;
        for (std::size_t i = 0; i < uses.size(); ++i) {
            const Use& use = uses[i];
            const bool new_vertex = i == 0 || uses[i - 1].vertex != use.vertex;
            if (new_vertex) {
                current = use.vertex;
                mesh_.normals[current] = to_float(normal(use.shared));
            } else if (uses[i - 1].shared != use.shared) {
                current = static_cast<std::uint32_t>(mesh_.positions.size());
                mesh_.positions.push_back(Vec3f(mesh_.positions[use.vertex]));
                mesh_.normals.push_back(to_float(normal(use.shared)));
            }
            mesh_.triangles[use.corner / 3][use.corner % 3] = current;
        }
    }

    TriangleMesh& mesh_;
    double crease_deg_;
    std::vector<std::uint32_t> places_;
    Groups groups_;
    std::vector<Vec3> facets_;
    std::vector<Vec3> sums_;
};

/// Makes the normal of a vertex a unit vector; false where that is impossible.
bool scale_to_unit(Vec3f& normal) {
    constexpr double kUnit = 1e-6;
    const Vec3 n = to_double(normal);
    const double size = length(n);
    if (!std::isfinite(size) || !(size > 0)) return false;
    if (std::abs(size - 1) > kUnit) normal = to_float((1 / size) * n);
    return true;
}

}  // namespace

void set_normals(TriangleMesh& mesh, NormalStyle style, double crease_deg) {
    if (!(crease_deg >= 0 && crease_deg <= 180))
        throw Error(ErrorCode::Usage, fmt::format("{} is outside 0 .. 180", crease_deg), "crease");
    if (style == NormalStyle::Facet) {
        mesh.normals.clear();
        return;
    }
    if (style == NormalStyle::AsGiven && !mesh.normals.empty()) return;
    Smoother(mesh, crease_deg).smooth();
}

std::uint64_t drop_undrawable(TriangleMesh& mesh) {
    const auto undrawable = [&](const Triangle& t) { return facet_normal(mesh, t) == Vec3{}; };
    const auto kept = std::remove_if(mesh.triangles.begin(), mesh.triangles.end(), undrawable);
    const auto dropped = static_cast<std::uint64_t>(mesh.triangles.end() - kept);
    mesh.triangles.erase(kept, mesh.triangles.end());

    std::vector<std::uint8_t> needs_facet(mesh.normals.size(), 0);
    for (std::size_t v = 0; v < mesh.normals.size(); ++v)
        needs_facet[v] = scale_to_unit(mesh.normals[v]) ? 0 : 1;
    for (const Triangle& t : mesh.triangles) {
        for (const std::uint32_t v : t) {
            if (mesh.normals.empty() || needs_facet[v] == 0) continue;
            mesh.normals[v] = to_float(facet_normal(mesh, t));
            needs_facet[v] = 0;
        }
    }
    // Of vertices that no triangle uses any normal will do.
    for (std::size_t v = 0; v < mesh.normals.size(); ++v) {
        if (needs_facet[v] != 0) mesh.normals[v] = {0, 1, 0};
    }
    return dropped;
}

}  // namespace asperity
