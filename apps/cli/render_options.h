// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "option_value.h"

#include <asperity/formats/images/render_writer.h>
#include <asperity/render/camera.h>
#include <asperity/render/mesh.h>
#include <asperity/render/render_settings.h>
#include <asperity/render/rgb.h>
#include <asperity/render/tonemap.h>

#include <CLI/CLI.hpp>

#include <array>
#include <initializer_list>
#include <map>
#include <string>
#include <vector>

namespace asperity::cli {

/// The names that an option of a picture takes; none where it takes something else.
std::vector<std::string> render_names(const std::string& option);

/// The options of `asperity render` that describe the picture, all from one table with their
/// defaults as texts: what help shows is what happens.
class RenderOptions {
  public:
    /// All of them, or `only` those named.
    void add_to(CLI::App& app, std::initializer_list<const char*> only = {});
    /// Takes over what the command line says; call it first, once that is parsed.
    void read();

    bool given(const std::string& name) const;
    /// As often as given, else the default alone, else nothing.
    const std::vector<std::string>& texts(const std::string& name) const;
    /// The last of them, for reading numbers and names; throws Error(Usage, name).
    OptionValue value(const std::string& name) const;

    /// Three numbers with "/" between them, or one for all; each within `range`.
    Rgb colour(const std::string& name, const Range& range) const;
    /// Of the first and the second BRDF: R/G/B[,R/G/B]; `otherwise` where there is none.
    std::array<Rgb, 2> two_colours(const std::string& name, const Range& range,
                                   Rgb otherwise) const;
    std::array<double, 2> two_numbers(const std::string& name, const Range& range,
                                      double otherwise) const;
    Vec3 vector(const std::string& name) const;

    /// What was given, and what decides most when it was not: enough to make the picture again.
    io::Provenance provenance() const;

  private:
    std::vector<std::string> names_;  ///< in the order of the help
    std::map<std::string, CLI::Option*> options_;
    std::map<std::string, std::vector<std::string>> texts_;
};

// What the options ask for. Throw Error(Usage, option).
RenderSettings render_settings(const RenderOptions& options);
ToneMapping tone_mapping(const RenderOptions& options);
Camera camera(const RenderOptions& options);

/// A model that was asked for, and what was left out of its file.
struct LoadedModel {
    Model model;
    std::uint64_t dropped_triangles = 0;
    std::vector<std::string> remarks;
};
/// Throws what read_model throws too.
LoadedModel load_model(const RenderOptions& options);

}  // namespace asperity::cli
