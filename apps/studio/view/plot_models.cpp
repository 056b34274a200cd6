// SPDX-License-Identifier: Apache-2.0
#include "plot_models.h"

#include <asperity/bsdf/spec.h>
#include <asperity/core/directions.h>
#include <asperity/core/error.h>
#include <asperity/measured/albedo_by_angle.h>
#include <asperity/measured/lobe_slice.h>

namespace asperity::studio {

namespace {

constexpr int kNormalBins = 180;   ///< half a degree each
constexpr double kAlbedoStep = 3;  ///< degrees

/// A plot of a lobe is the same lobe on either paper.
PlotKind kind_of_curves(PlotKind kind) {
    return kind == PlotKind::LobeCartesian ? PlotKind::LobePolar : kind;
}

/// A model and the channel of it to be shown.
struct ShownModel {
    std::unique_ptr<Bsdf> brdf;
    int channel = -1;
};

/// A model without the measurement's channels is shown as the mean of its own.
ShownModel make_model(const std::string& spec, const ModelWish& wish) {
    ShownModel model{parse_brdf_spec(spec), -1};
    if (wish.head && model.brdf->channels() == wish.head->channels()) model.channel = wish.channel;
    return model;
}

void require_going(const Run& run) {
    if (!run.keep_going()) throw Error(ErrorCode::Stopped, "stopped");
}

std::vector<double> albedo_curve(const ShownModel& model, const std::vector<double>& theta_deg,
                                 const Run& run) {
    std::vector<double> albedo;
    for (const double theta : theta_deg) {
        require_going(run);
        albedo.push_back(albedo_at(*model.brdf, radians(theta), model.channel));
    }
    return albedo;
}

std::vector<double> lobe_curve(const ShownModel& model, const ModelWish& wish) {
    Layer layer;
    layer.theta_i = wish.theta_i;
    layer.phi_i = wish.phi_i;
    std::vector<double> f;
    for (const LobeSample& sample :
         lobe_slice(*model.brdf, *wish.head, layer, model.channel).samples)
        f.push_back(sample.f);
    return f;
}

std::vector<double> normals_curve(const ShownModel& model, const Run& run) {
    const auto profile = normal_profile(*model.brdf, kNormalBins, run);
    return profile ? profile->density : std::vector<double>();
}

std::vector<double> abscissae(const ModelWish& wish) {
    std::vector<double> x;
    if (wish.kind == PlotKind::Albedo) {
        for (double theta = 0; theta < 90; theta += kAlbedoStep) x.push_back(theta);
    } else if (wish.kind == PlotKind::Normals) {
        for (int t = 0; t < kNormalBins; ++t) x.push_back(90 * (t + 0.5) / kNormalBins);
    } else {
        const Detector& detector = wish.head->detector;
        for (int row = detector.rows(); row-- > 0;)
            x.push_back(-degrees(detector.theta_centre(row)));
        for (int row = 0; row < detector.rows(); ++row)
            x.push_back(degrees(detector.theta_centre(row)));
    }
    return x;
}

std::shared_ptr<const ModelValues> values_of(const ModelWish& wish,
                                             std::shared_ptr<const NormalProfile> normals,
                                             const Run& run) {
    auto values = std::make_shared<ModelValues>();
    values->wish = wish;
    values->x = abscissae(wish);
    if (wish.kind == PlotKind::Normals)
        values->normals = normals ? std::move(normals)
                                  : std::make_shared<const NormalProfile>(
                                        normal_profile(*wish.surface, kNormalBins, run));
    for (const OverlayModel& overlay : wish.models) {
        require_going(run);
        values->y.emplace_back();
        try {
            const ShownModel model = make_model(overlay.spec, wish);
            values->y.back() = wish.kind == PlotKind::Normals  ? normals_curve(model, run)
                               : wish.kind == PlotKind::Albedo ? albedo_curve(model, values->x, run)
                                                               : lobe_curve(model, wish);
        } catch (const Error& error) {  // the others are shown
            if (error.code() == ErrorCode::Stopped) throw;
            values->trouble = QString::fromUtf8(error.what());
        }
    }
    return values;
}

}  // namespace

bool ModelWish::same_scene(const ModelWish& other) const {
    return kind_of_curves(kind) == kind_of_curves(other.kind) && head == other.head &&
           theta_i == other.theta_i && phi_i == other.phi_i && channel == other.channel &&
           surface == other.surface;
}

ModelCurves::ModelCurves(QObject* parent)
    : QObject(parent), background_(this, [this](const QString& sentence) {
          emit failed(sentence);
          serve_waiting();
      }) {}

const ModelValues* ModelCurves::find(const ModelWish& wish) const {
    const auto found = found_.find(kind_of_curves(wish.kind));
    if (found == found_.end() || !found->second->wish.same_scene(wish)) return nullptr;
    return found->second.get();
}

void ModelCurves::want(const ModelWish& wish) {
    const ModelValues* found = find(wish);
    if (found != nullptr && found->wish.models == wish.models) {
        waiting_.reset();
    } else if (background_.busy()) {
        waiting_ = wish;
    } else {
        start(wish);
    }
}

void ModelCurves::start(const ModelWish& wish) {
    const ModelValues* before = find(wish);
    background_.start([this, wish, normals = before ? before->normals : nullptr](
                          Run& run, const Background::Post&) {
        const auto values = values_of(wish, normals, run);
        return [this, values] { take(values); };
    });
}

void ModelCurves::take(std::shared_ptr<const ModelValues> values) {
    const QString trouble = values->trouble;
    found_[kind_of_curves(values->wish.kind)] = std::move(values);
    emit changed();
    if (!trouble.isEmpty()) emit failed(trouble);
    serve_waiting();
}

void ModelCurves::serve_waiting() {
    if (!waiting_ || background_.busy()) return;
    const ModelWish next = *waiting_;
    waiting_.reset();
    want(next);
}

}  // namespace asperity::studio
