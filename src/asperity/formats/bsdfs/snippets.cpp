// SPDX-License-Identifier: Apache-2.0
#include <asperity/core/error.h>
#include <asperity/formats/atomic_file.h>
#include <asperity/formats/bsdfs/snippets.h>

#include <fmt/format.h>

#include <algorithm>
#include <filesystem>
#include <initializer_list>
#include <utility>

namespace asperity::io {
namespace {

// {0}: the name of the exported file, {1}: the same without its ending, {2}: a variant of Mitsuba.
constexpr const char* kMitsubaScene = R"(<scene version="3.0.0">
    <default name="resx" value="512"/>
    <default name="resy" value="512"/>
    <integrator type="path"/>
    <sensor type="perspective">
        <float name="fov" value="32"/>
        <transform name="to_world">
            <lookat origin="0, -4, 1" target="0, 0, 0" up="0, 0, 1"/>
        </transform>
        <film type="hdrfilm">
            <integer name="width" value="$resx"/>
            <integer name="height" value="$resy"/>
        </film>
        <sampler type="independent"><integer name="sample_count" value="64"/></sampler>
    </sensor>
    <emitter type="constant"><rgb name="radiance" value="0.4"/></emitter>
    <emitter type="directional">
        <vector name="direction" x="-1" y="1" z="-1"/>
        <rgb name="irradiance" value="2"/>
    </emitter>
    <shape type="sphere">
        <bsdf type="measured"><string name="filename" value="{0}"/></bsdf>
    </shape>
</scene>
)";

constexpr const char* kMitsubaScript = R"(import pathlib

import mitsuba as mi

mi.set_variant("{2}")  # or another one of the same colours
here = pathlib.Path(__file__).parent
scene = mi.load_file(str(here / "{1}_mitsuba.xml"))
mi.util.write_bitmap(str(here / "{1}_mitsuba.png"), mi.render(scene))
)";

constexpr const char* kPbrtScene = R"(LookAt 0 -4 1  0 0 0  0 0 1
Camera "perspective" "float fov" 32
Sampler "halton" "integer pixelsamples" 64
Film "rgb" "string filename" "{1}_pbrt.exr" "integer xresolution" 512 "integer yresolution" 512
WorldBegin
LightSource "infinite" "rgb L" [0.4 0.4 0.4]
LightSource "distant" "point3 from" [1 -1 1] "point3 to" [0 0 0] "rgb L" [2 2 2]
Material "measured" "string filename" "{0}"
Shape "sphere"
)";

// Thickness 0, the file, the direction that is up, no function file.
constexpr const char* kRadianceScene = R"(void BSDF measured
6 0 {0} 0 0 1 .
0
0

measured sphere measured_ball
0
0
4 0 0 0 1
)";

/// With each of some characters put in other words.
std::string escaped(const std::string& name,
                    std::initializer_list<std::pair<char, const char*>> words) {
    std::string text;
    for (const char c : name) {
        const auto* const found =
            std::find_if(words.begin(), words.end(), [c](const auto& w) { return w.first == c; });
        text += found == words.end() ? std::string(1, c) : found->second;
    }
    return text;
}

std::string in_xml(const std::string& name) {
    return escaped(name, {{'&', "&amp;"}, {'<', "&lt;"}, {'>', "&gt;"}, {'"', "&quot;"}});
}

/// Between double quotes, of Python or pbrt.
std::string in_string(const std::string& name) {
    return escaped(name, {{'"', "\\\""}, {'\\', "\\\\"}});
}

/// Radiance parts words at spaces unless they stand between quotes.
std::string in_radiance(const std::string& name) {
    return name.find(' ') == name.npos ? name : '"' + name + '"';
}

struct Snippet {
    const char* ending;
    const char* text;
    std::string (*name)(const std::string& name);  ///< of a file, as the snippet's language has it
};

std::vector<Snippet> snippets_of(const std::string& format, bool spectral) {
    std::vector<Snippet> snippets;
    if (format == "rgl")
        snippets = {{"_mitsuba.xml", kMitsubaScene, in_xml},
                    {"_mitsuba.py", kMitsubaScript, in_string}};
    if (format == "rgl" && spectral) snippets.push_back({"_pbrt.pbrt", kPbrtScene, in_string});
    if (format == "klems" || format == "tensortree")
        snippets = {{"_radiance.rad", kRadianceScene, in_radiance}};
    return snippets;
}

}  // namespace

void require_snippets(const std::string& format) {
    if (snippets_of(format, false).empty())
        throw Error(ErrorCode::Usage,
                    "there are scenes for rgl (Mitsuba, pbrt), klems and tensortree (Radiance), "
                    "none for " +
                        format,
                    "snippet");
}

std::vector<std::string> write_snippets(const std::string& format, const FormatOptions& options,
                                        const std::string& path) {
    require_snippets(format);
    const bool spectral = format == "rgl" && options.text("colour") == "spectral";
    const std::filesystem::path file(path);
    const std::string stem = file.stem().string();
    std::vector<std::string> written;
    for (const Snippet& snippet : snippets_of(format, spectral)) {
        AtomicFile out((file.parent_path() / (stem + snippet.ending)).string());
        out.write(fmt::format(fmt::runtime(snippet.text), snippet.name(file.filename().string()),
                              snippet.name(stem), spectral ? "scalar_spectral" : "scalar_rgb"));
        out.commit();
        written.push_back(out.path());
    }
    return written;
}

}  // namespace asperity::io
