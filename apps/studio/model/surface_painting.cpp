// SPDX-License-Identifier: Apache-2.0
#include "surface_painting.h"

#include <asperity/core/parallel.h>

#include <algorithm>
#include <cmath>

namespace asperity::studio {

namespace {

using BodyPixel = SurfaceBody::Pixel;

constexpr BodyPixel kSelected = {255, 245, 190};
constexpr float kSelectedShare = 0.85F;

/// The dark round the scene where no layer is shown, and below the horizon: black but for a breath
/// of blue at the horizon. `direction` in the world, unit length.
BodyPixel darkness(Vec3 direction) {
    const auto glow = static_cast<float>(std::exp(-9 * std::abs(direction.y)));
    return {9 * glow, 11 * glow, 16 * glow};
}

/// Place of a sample within its pixel: the middle first, then spread evenly (Roberts 2018, "The
/// unreasonable effectiveness of quasirandom sequences").
std::pair<double, double> place_of_sample(int pass) {
    const double x = 0.5 + 0.7548776662466927 * pass, y = 0.5 + 0.5698402909980532 * pass;
    return {x - std::floor(x), y - std::floor(y)};
}

class SurfacePainting : public Painting {
  public:
    SurfacePainting(SurfacePicture picture, const Camera& camera, QSize size)
        : picture_(std::move(picture)),
          camera_(camera),
          image_(size, QImage::Format_RGB32),
          sums_(static_cast<std::size_t>(size.width()) * static_cast<std::size_t>(size.height())) {}

    bool pass(Run& run) override {
        body_ = picture_.body ? &picture_.body->get() : nullptr;
        dome_ = picture_.dome ? &picture_.dome->get() : nullptr;
        lobes_.clear();
        radius_ = 0;
        for (const auto& lobe : picture_.lobes) {
            lobes_.push_back(&lobe->get());
            radius_ = std::max(radius_, lobes_.back()->radius());
        }
        const auto [x, y] = place_of_sample(passes_);
        // Rows are written by several threads: the picture must be ours alone by now.
        bits_ = image_.bits();
        if (!(body_ ? paint_with_body(x, y, run) : paint_dome(x, y, run))) return false;
        return ++passes_ < kSurfaceSamples;
    }

    QImage image() const override { return image_; }

  private:
    static constexpr double kFarAway = 1e30;

    static WorldRay to_world(const SurfaceFrame& frame, const WorldRay& ray) {
        return {SurfaceFrame::direction_to_world(frame.scale * (ray.origin - frame.middle)),
                SurfaceFrame::direction_to_world(ray.direction)};
    }

    /// What the pixels of a row see of the lobes.
    struct LobeRow {
        const std::vector<const Lobe*>* lobes = nullptr;
        std::vector<WorldRay> rays;          ///< those that may meet one
        std::vector<std::vector<Hit>> hits;  ///< of these, for each lobe
        std::vector<std::int32_t> of_pixel;  ///< which of them; -1: none

        /// `behind` lies at that distance from the eye; lobes let some of it through.
        BodyPixel over(std::size_t pixel, double distance, const BodyPixel& behind) const {
            if (of_pixel.empty() || of_pixel[pixel] < 0) return behind;
            const auto at = static_cast<std::size_t>(of_pixel[pixel]);
            // From the farthest to the nearest; there are a handful
            BodyPixel colour = behind;
            double nearer_than = distance;
            while (true) {
                std::size_t next = hits.size();
                for (std::size_t k = 0; k < hits.size(); ++k) {
                    const Hit& hit = hits[k][at];
                    const auto far = static_cast<double>(hit.distance);
                    if (!hit.found() || !(far < nearer_than)) continue;
                    if (next == hits.size() || far > static_cast<double>(hits[next][at].distance))
                        next = k;
                }
                if (next == hits.size()) return colour;
                const Hit& hit = hits[next][at];
                const Lobe& lobe = *(*lobes)[next];
                const auto share = static_cast<float>(lobe.opacity(rays[at], hit));
                const BodyPixel own = lobe.colour(rays[at], hit);
                for (std::size_t c = 0; c < 3; ++c) colour[c] += share * (own[c] - colour[c]);
                nearer_than = static_cast<double>(hit.distance);
            }
        }
    };

    template <class RayOf>
    LobeRow look_at_lobes(std::size_t width, const RayOf& ray_of) const {
        LobeRow row;
        if (lobes_.empty()) return row;
        row.lobes = &lobes_;
        row.of_pixel.assign(width, -1);
        for (std::size_t k = 0; k < width; ++k) {
            const WorldRay ray = ray_of(k);
            const double middle = -dot(ray.origin, ray.direction);
            const double passes = dot(ray.origin, ray.origin) - middle * middle;
            if (passes > radius_ * radius_) continue;
            row.of_pixel[k] = static_cast<std::int32_t>(row.rays.size());
            row.rays.push_back(ray);
        }
        for (const Lobe* lobe : lobes_) {
            row.hits.emplace_back(row.rays.size());
            if (!row.rays.empty()) lobe->look(row.rays, row.hits.back());
        }
        return row;
    }

    bool paint_with_body(double x, double y, Run& run) {
        const SurfaceFrame& frame = body_->frame();
        return look_at_heightfield(
            body_->view(), frame.to_surface(camera_), image_.width(), image_.height(), x, y, run,
            [&](int row, std::span<const WorldRay> rays, std::span<const PatchHit> hits) {
                const LobeRow lobe = look_at_lobes(
                    rays.size(), [&](std::size_t k) { return to_world(frame, rays[k]); });
                add_row(row, [&](std::size_t k) {
                    const bool on_surface = hits[k].part != PatchPart::None;
                    const BodyPixel behind = on_surface ? colour_of(rays[k], hits[k])
                                                        : surroundings(to_world(frame, rays[k]));
                    const double distance = on_surface ? frame.scale * hits[k].distance : kFarAway;
                    return lobe.over(k, distance, behind);
                });
            });
    }

    bool paint_dome(double x, double y, Run& run) {
        const PixelRays rays(camera_, image_.width(), image_.height());
        const auto row = [&](std::size_t k) {
            if (run.stop_requested()) return;
            const auto ray = [&](std::size_t column) {
                return rays.at(static_cast<double>(column) + x, static_cast<double>(k) + y);
            };
            const LobeRow lobe = look_at_lobes(static_cast<std::size_t>(image_.width()), ray);
            add_row(static_cast<int>(k), [&](std::size_t column) {
                return lobe.over(column, kFarAway, surroundings(ray(column)));
            });
        };
        parallel_for(static_cast<std::size_t>(image_.height()), run.threads(), row);
        return !run.stop_requested();
    }

    BodyPixel colour_of(const WorldRay& ray, const PatchHit& hit) const {
        BodyPixel colour = body_->colour(ray, hit, picture_.shading, picture_.metal);
        if (hit.part == PatchPart::Facet && picture_.selected && !picture_.selected->empty() &&
            picture_.selected->contains({hit.i, hit.j, hit.triangle}))
            for (std::size_t c = 0; c < 3; ++c)
                colour[c] += kSelectedShare * (kSelected[c] - colour[c]);
        return colour;
    }

    /// What a ray of the world sees that misses the surface.
    BodyPixel surroundings(const WorldRay& ray) const {
        const std::optional<Vec3> direction = dome_direction(ray);
        if (!direction) return darkness(ray.direction);
        if (!dome_ || direction->y < 0) return darkness(*direction);
        return dome_->colour(SurfaceFrame::direction_to_surface(*direction));
    }

    /// Adds a sample to each pixel of a row, and shows the mean.
    template <class Sample>
    void add_row(int row, const Sample& sample) {
        const auto width = static_cast<std::size_t>(image_.width());
        BodyPixel* sums = sums_.data() + static_cast<std::size_t>(row) * width;
        auto* line = reinterpret_cast<QRgb*>(bits_ + row * image_.bytesPerLine());
        const float share = 1.0F / static_cast<float>(passes_ + 1);
        for (std::size_t k = 0; k < width; ++k) {
            const BodyPixel colour = sample(k);
            for (std::size_t c = 0; c < 3; ++c) sums[k][c] += colour[c];
            const auto level = [&](std::size_t c) {
                return static_cast<int>(sums[k][c] * share + 0.5F);
            };
            line[k] = qRgb(level(0), level(1), level(2));
        }
    }

    const SurfacePicture picture_;
    const Camera camera_;
    QImage image_;
    std::vector<BodyPixel> sums_;
    int passes_ = 0;
    const SurfaceBody* body_ = nullptr;
    const DomePicture* dome_ = nullptr;
    std::vector<const Lobe*> lobes_;
    double radius_ = 0;  ///< of the largest of them
    uchar* bits_ = nullptr;
};

}  // namespace

FacetSet::FacetSet(const std::vector<LightPath>& paths) {
    for (const LightPath& path : paths)
        for (const FacetId& facet : path.facets) keys_.insert(key(facet));
}

BeginPainting paint_surface(SurfacePicture picture, const Camera& camera) {
    return [picture = std::move(picture), camera](QSize size) -> std::unique_ptr<Painting> {
        return std::make_unique<SurfacePainting>(picture, camera, size);
    };
}

}  // namespace asperity::studio
