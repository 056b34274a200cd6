// SPDX-License-Identifier: Apache-2.0
#include "figures_of_surface.h"

#include <utility>

namespace asperity::studio {

FiguresOfSurface::FiguresOfSurface(QObject* parent)
    : QObject(parent), background_(this, [this](const QString& why) {
          rows_ = {{"", why.toStdString()}};
          emit changed();
      }) {}

void FiguresOfSurface::want(std::shared_ptr<const Heightfield> patch, double wavelength) {
    if (patch == patch_ && wavelength == wavelength_ && (busy() || !rows_.empty())) return;
    patch_ = std::move(patch);
    wavelength_ = wavelength;
    rows_.clear();
    run_ = std::make_shared<Run>();
    background_.start(
        [this, patch = patch_, wavelength](Run& run, const Background::Post&) {
            const auto rows = texture_rows(texture_figures(*patch, wavelength, run), *patch);
            return [this, rows] {
                rows_ = rows;
                emit changed();
            };
        },
        run_);
    emit changed();
}

void FiguresOfSurface::forget() {
    background_.cancel();
    patch_ = nullptr;
    rows_.clear();
    emit changed();
}

void FiguresOfSurface::stop() {
    if (!busy()) return;
    background_.cancel();
    emit changed();
}

}  // namespace asperity::studio
