// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <asperity/formats/bsdfs/bsdf_format.h>

#include <string>
#include <vector>

namespace asperity::io {

/// How well a file holds what it was made from: it is read back as the format's own readers do, and
/// compared cell by cell, layer by layer below 85 degrees.
struct Fidelity {
    /// One incidence. l1: integral of |f - f_file| cos(theta_o) over the hemisphere, as a share of
    /// the albedo of the source, channels averaged.
    struct LayerFidelity {
        double theta_i = 0, phi_i = 0;
        double l1 = 0;
        double noise = 0;              ///< what l1 the error bars of the source alone would give
        double albedo_difference = 0;  ///< file - source, absolute
    };
    std::vector<LayerFidelity> layers;
    double mean_l1 = 0, worst_l1 = 0, worst_theta_i = 0;
    double mean_noise = 0;
    /// Mean L1 of the source against what it is for a format without azimuths, isotropic and
    /// mirrored: no isotropic file can be closer. Negative: not asked, the file has azimuths.
    double mean_isotropy = -1;
    /// Mean L1 of the file against the continuous function it was made from, noise apart: what the
    /// format alone loses. Negative: the source is no measurement, mean_l1 says it.
    double mean_format = -1;
    double max_albedo_difference = 0;  ///< the one farthest from 0, with its sign
};

/// Reads `path` back and compares. A source that the format can only hold as an isotropic one is
/// compared as such at every azimuth, so what is lost shows. Throws what reading throws, and
/// Error(Usage) when the format cannot be read.
Fidelity fidelity_of(const ExportSource& source, const BsdfFormat& format, const std::string& path);

/// "mean L1 of f cos 0.8 %, worst 1.2 % at 84 degrees, albedo at most +0.0012 off (noise 0.3 %)".
std::string to_text(const Fidelity& fidelity);

}  // namespace asperity::io
