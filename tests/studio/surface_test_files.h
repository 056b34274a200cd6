// SPDX-License-Identifier: Apache-2.0
// Surfaces as instruments write them, made so that what must come out is known.
#pragma once

#include <asperity/core/directions.h>
#include <asperity/core/vec.h>

#include <QByteArray>

#include <cmath>
#include <cstdint>
#include <random>

namespace asperity::studio::testing {

inline constexpr int kSide = 64;
inline constexpr double kStep = 0.5, kAmplitude = 0.2, kTilt = 0.03;  // um, um, slope

/// Two waves on a tilted plane. A cosine with its crest at the edge is symmetric about the middle:
/// the plane that fits best is the one that was added, and what is left has Sq = amplitude/sqrt(2).
inline double height_at(int x, int y, double amplitude) {
    const double wave = 2 * kPi * 2 / kSide;
    return kTilt * kStep * x - 0.5 * kTilt * kStep * y + amplitude * std::cos(wave * (x + 0.5));
}

/// As instruments write it, in micrometres; `hole` points in the middle of a slope are missing.
inline QByteArray text_file(int hole) {
    QByteArray text = "# Channel: Height\n# Width: 32.0 um\n# Height: 32.0 um\n# Value units: um\n";
    for (int y = 0; y < kSide; ++y) {
        for (int x = 0; x < kSide; ++x) {
            const bool gone = x >= 30 && x < 30 + hole && y >= 20 && y < 20 + hole;
            text +=
                gone ? QByteArray("nan") : QByteArray::number(height_at(x, y, kAmplitude), 'f', 9);
            text += x + 1 < kSide ? " " : "\n";
        }
    }
    return text;
}

/// As measured: a ground surface that lay tilted, with a spike and points that gave no light back.
inline QByteArray ground_file() {
    constexpr int kSamples = 192, kWaves = 40;
    std::mt19937 random(7);
    const auto draw = [&] { return static_cast<double>(random()) / 4294967296.0; };
    double kx[kWaves], ky[kWaves], phase[kWaves];
    for (int k = 0; k < kWaves; ++k) {
        kx[k] = 0.9 * (draw() - draw());
        ky[k] = 0.16 * (draw() - draw());
        phase[k] = 2 * kPi * draw();
    }
    QByteArray text = "# Channel: Height\n# Width: 96.0 um\n# Height: 96.0 um\n# Value units: um\n";
    for (int y = 0; y < kSamples; ++y) {
        for (int x = 0; x < kSamples; ++x) {
            double h = x == 40 && y == 30 ? 9 : 0.02 * kStep * x;
            for (int k = 0; k < kWaves; ++k)
                h += 0.09 * std::cos(kStep * (kx[k] * x + ky[k] * y) + phase[k]);
            const bool gone = std::hypot(x - 120, 2 * (y - 60)) < 14 || draw() < 0.002;
            text += (gone ? QByteArray("nan") : QByteArray::number(h, 'f', 5)) + ' ';
        }
        text += '\n';
    }
    return text;
}

template <typename Number>
inline QByteArray little(Number value) {
    return {reinterpret_cast<const char*>(&value), sizeof value};
}

inline QByteArray gwy_object(const QByteArray& type, const QByteArray& parts) {
    return type + '\0' + little(static_cast<std::uint32_t>(parts.size())) + parts;
}

inline QByteArray gwy_unit(const QByteArray& name, const QByteArray& unit) {
    return name + '\0' + 'o' +
           gwy_object("GwySIUnit", QByteArray("unitstr") + '\0' + 's' + unit + '\0');
}

inline QByteArray gwy_field(double amplitude, const QByteArray& unit) {
    const auto part = [](const char* name, char type, const QByteArray& value) {
        return QByteArray(name) + '\0' + type + value;
    };
    QByteArray heights;
    for (int y = 0; y < kSide; ++y)
        for (int x = 0; x < kSide; ++x) heights += little(1e-6 * height_at(x, y, amplitude));
    return gwy_object(
        "GwyDataField",
        part("xres", 'i', little(kSide)) + part("yres", 'i', little(kSide)) +
            part("xreal", 'd', little(32e-6)) + part("yreal", 'd', little(32e-6)) +
            gwy_unit("si_unit_xy", "m") + gwy_unit("si_unit_z", unit) +
            part("data", 'D', little(static_cast<std::uint32_t>(kSide * kSide)) + heights));
}

/// Two channels of heights, the second with waves of twice the height, and one of a voltage.
inline QByteArray gwy_file() {
    QByteArray parts;
    const auto add = [&](int number, const char* title, const QByteArray& field) {
        const QByteArray key = "/" + QByteArray::number(number) + "/data";
        parts += key + '\0' + 'o' + field + key + "/title" + '\0' + 's' + title + '\0';
    };
    add(0, "Height", gwy_field(kAmplitude, "m"));
    add(1, "Second", gwy_field(2 * kAmplitude, "m"));
    add(2, "Sensor", gwy_field(kAmplitude, "V"));
    return "GWYP" + gwy_object("GwyContainer", parts);
}

}  // namespace asperity::studio::testing
