// SPDX-License-Identifier: Apache-2.0
#include <asperity/bsdf/models/lambert.h>
#include <asperity/bsdf/models/plus_lambert.h>
#include <asperity/core/directions.h>
#include <asperity/core/error.h>
#include <asperity/params/fields.h>

#include <fmt/format.h>

#include <algorithm>

namespace asperity {

PlusLambertBrdf::PlusLambertBrdf(std::unique_ptr<Bsdf> first, std::vector<double> albedo)
    : first_(std::move(first)), albedo_(std::move(albedo)) {
    const auto own = static_cast<std::size_t>(first_->channels());
    const std::size_t count = albedo_.size();
    if (count == 0 || count > static_cast<std::size_t>(kMaxBsdfChannels) ||
        (count != 1 && own != 1 && count != own))
        throw Error(ErrorCode::Usage,
                    fmt::format("{} values given, the model has {} channel{}", count, own,
                                own == 1 ? "" : "s"),
                    kLambertKey);
    double sum = 0;
    for (const double a : albedo_) {
        if (!kZeroToOne.contains(a))
            throw Error(ErrorCode::Usage, fmt::format("{} is not within 0 .. 1", a), kLambertKey);
        sum += a;
    }
    channels_ = static_cast<int>(std::max(own, count));
    // By energy, if the other part reflected half; some of each always.
    const double mean = sum / static_cast<double>(count);
    diffuse_share_ = std::clamp(mean / (mean + 0.5), 0.1, 0.9);
}

std::string PlusLambertBrdf::name() const {
    const std::string first = first_->name();
    return fmt::format("{}{}{}={}", first, first.find(':') == first.npos ? ":" : ",", kLambertKey,
                       fmt::join(albedo_, "/"));
}

std::span<double> PlusLambertBrdf::of_first(std::span<double> values) const {
    return values.first(static_cast<std::size_t>(first_->channels()));
}

/// To values of the first part in the front of `values`, for all channels.
void PlusLambertBrdf::add(std::span<double> values, double scale) const {
    if (first_->channels() == 1) std::fill(values.begin() + 1, values.end(), values.front());
    for (std::size_t c = 0; c < values.size(); ++c)
        values[c] += scale * albedo_[albedo_.size() == 1 ? 0 : c];
}

void PlusLambertBrdf::eval(Vec3 wi, Vec3 wo, std::span<double> f) const {
    first_->eval(wi, wo, of_first(f));
    add(f, wi.z > 0 && wo.z > 0 ? 1 / kPi : 0.0);
}

std::optional<BsdfSample> PlusLambertBrdf::sample(Vec3 wi, double u1, double u2) const {
    if (wi.z <= 0) return std::nullopt;
    Vec3 wo;
    if (u1 < diffuse_share_) {
        wo = sample_cosine(u1 / diffuse_share_, u2);
    } else {
        const auto drawn = first_->sample(wi, (u1 - diffuse_share_) / (1 - diffuse_share_), u2);
        if (!drawn) return std::nullopt;
        wo = drawn->wo;
    }
    const double density = pdf(wi, wo);
    if (!(density > 0)) return std::nullopt;
    return BsdfSample{wo, density};
}

double PlusLambertBrdf::pdf(Vec3 wi, Vec3 wo) const {
    if (wi.z <= 0 || wo.z <= 0) return 0;
    return diffuse_share_ * wo.z / kPi + (1 - diffuse_share_) * first_->pdf(wi, wo);
}

void PlusLambertBrdf::albedo(Vec3 wi, std::span<double> a) const {
    first_->albedo(wi, of_first(a));
    add(a, wi.z > 0 ? 1.0 : 0.0);
}

BsdfModel plus_lambert(BsdfModel model) {
    ParamInfo info{.name = kLambertKey,
                   .label = "plus Lambert",
                   .metavar = "X[/Y/Z]",
                   .range = kZeroToOne,
                   .absent = "none",
                   .doc =
                       "albedo of a diffuse part that is added, f + albedo / pi, one value or "
                       "one per channel",
                   .type = ParamType::List};
    model.params.push_back({info, info.absent, false});
    model.make = [make = model.make, info](const SpecSettings& given) -> std::unique_ptr<Bsdf> {
        SpecSettings own;
        ParamValue albedo;
        for (const auto& [key, value] : given) {
            if (key != kLambertKey) {
                own.emplace_back(key, value);
                continue;
            }
            albedo = parse(info, from_spec_text(info, value));
            check(info, albedo);
        }
        std::unique_ptr<Bsdf> first = make(own);
        const auto* list = std::get_if<std::vector<double>>(&albedo);
        if (list == nullptr || list->empty()) return first;  // "none"
        return std::make_unique<PlusLambertBrdf>(std::move(first), *list);
    };
    return model;
}

}  // namespace asperity
