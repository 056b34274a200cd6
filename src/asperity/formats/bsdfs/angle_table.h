// SPDX-License-Identifier: Apache-2.0
#pragma once

// f over a grid of angles, as instruments and the programs of optical design write it; inside this
// folder only.

#include <asperity/formats/bsdfs/cosine_sampled.h>
#include <asperity/formats/bsdfs/export_source.h>

#include <string>
#include <vector>

namespace asperity::io {

/// What outgoing angles are counted from.
enum class AngleFrame {
    Normal,    ///< polar angle from the normal, azimuth from that of the light plus azimuth_zero
    Specular,  ///< polar angle from the mirror direction, azimuth about it, 0 towards the normal
};

/// f [1/sr], index (((phi_i * T + theta_i) * channels + channel) * P + polar) * A + azimuth.
struct AngleTable {
    AngleFrame frame = AngleFrame::Normal;
    double azimuth_zero =
        0;                  ///< Normal: what the file calls azimuth 0 lies here beyond the light's
    bool mirrored = false;  ///< azimuths 0 .. pi stand for both sides of the plane of incidence
    int channels = 1;
    std::vector<std::string> channel_names;  ///< wavelengths, "550nm", where they are known
    std::vector<double> phi_i = {0}, theta_i, polar, azimuth;  ///< [rad], rising
    std::vector<double> f;

    std::size_t directions() const { return polar.size() * azimuth.size(); }
    std::size_t block(std::size_t phi, std::size_t theta, int channel) const {
        return ((phi * theta_i.size() + theta) * static_cast<std::size_t>(channels) +
                static_cast<std::size_t>(channel)) *
               directions();
    }
    std::size_t size() const {
        return phi_i.size() * theta_i.size() * static_cast<std::size_t>(channels) * directions();
    }
};

/// The direction at these angles for light from `wi`.
Vec3 direction_of(const AngleTable& table, Vec3 wi, double polar, double azimuth);

/// Integral of f cos(theta_o) over the hemisphere for one incidence, by the rule of trapezoids;
/// 0 for a grid of one polar angle or azimuth.
double integral_of(const AngleTable& table, std::size_t phi, std::size_t theta, int channel);

/// Sets f of a table whose angles are set: f of `bsdf` at the nodes, channels mixed by `mixture`,
/// a row of weights for each of the table's.
void fill(AngleTable& table, const Bsdf& bsdf, const std::vector<std::vector<double>>& mixture,
          int threads);

/// `count` angles from `first` to `last` [deg], in radians.
std::vector<double> even_angles(double first_deg, double last_deg, double step_deg);

/// Incident polar angles for a table: those measured, of a file of a table its own, or every 5
/// degrees up to 85.
std::vector<double> table_thetas(const ExportSource& source);

/// A Bsdf of a table, linear between its nodes, clamped at its first and last incidence, zero
/// beyond its last polar angle. Throws Error(InvalidInput, where) for a table whose angles do not
/// rise or lie outside the hemisphere, or that holds what is no number. Negative f count as 0.
std::unique_ptr<Bsdf> make_table_bsdf(AngleTable table, std::string name, const std::string& where);

/// A row of a list of measured values.
struct AngleRow {
    double phi_i = 0, theta_i = 0, theta_o = 0;
    double phi_o = 0;  ///< from the azimuth of the light
    std::vector<double> f;
};
/// The table that rows in any order form. Throws Error(InvalidInput, where) unless they are every
/// combination of the angles that occur, once.
AngleTable table_of_rows(std::vector<AngleRow> rows, const std::string& where);

/// Linear sRGB from XYZ of the same white, and back.
std::array<double, 3> rgb_of_xyz(const std::array<double, 3>& xyz);
/// A mixture for fill(): X, Y and Z of red, green and blue where there are three channels, else the
/// mean.
std::vector<std::vector<double>> tristimulus_or_luminance(const ExportSource& source);

}  // namespace asperity::io
