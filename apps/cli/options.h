// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <asperity/gonio/experiment.h>

#include <CLI/CLI.hpp>

#include <initializer_list>
#include <string>
#include <vector>

namespace asperity::cli {

/// The groups of options in the order help shows them.
inline constexpr const char* kSurface = "Surface";
inline constexpr const char* kModel = "Model";
inline constexpr const char* kMaterial = "Material";
inline constexpr const char* kLight = "Light";
inline constexpr const char* kCamera = "Camera";
inline constexpr const char* kFacets = "Facets";
inline constexpr const char* kDetector = "Detector";
inline constexpr const char* kRun = "Run";
inline constexpr const char* kOutput = "Output";

inline constexpr const char* kGroups[] = {kSurface, kModel,    kMaterial, kLight, kCamera,
                                          kFacets,  kDetector, kRun,      kOutput};

/// Adds an option that takes one value, a text; the last of several wins.
CLI::Option* add_text(CLI::App& app, const std::string& name, const std::string& metavar,
                      const std::string& help, const std::string& group);

/// A row of a table of options.
struct OptionInfo {
    const char* name;     ///< without dashes
    const char* metavar;  ///< empty: a flag
    const char* group;
    const char* help;
    const char* otherwise = "";  ///< what happens without the option, if the table says it
};

/// Adds an option of a table; help shows `otherwise` unless it is a flag.
CLI::Option* add_option(CLI::App& app, const OptionInfo& info, const std::string& otherwise);

/// The value of an option, or `otherwise` when it was not given.
std::string text_of(const CLI::Option* option, const std::string& otherwise = {});

/// A whole number between two bounds, written in digits. Throws Error(Usage, name).
int parse_count(const std::string& name, const std::string& text, int least, int most);

/// A finite number > 0. Throws Error(Usage, name).
double parse_positive(const std::string& name, const std::string& text);

/// --threads, --quiet and --json, for the verbs that have them.
struct ThreadsOption {
    CLI::Option* option = nullptr;
    void add_to(CLI::App& app);
    int threads() const;  ///< 0: as many as the machine has
};

/// The options that describe an experiment, all from one table; their values are read by
/// apply_setting, on the command line as in a --config file.
class ExperimentOptions {
  public:
    /// Adds the options of these groups and --config. `surface_option`: with --surface; a verb that
    /// takes the surface as its argument goes without.
    void add_to(CLI::App& app, std::initializer_list<const char*> groups, bool surface_option);

    /// Reads --config, if given, then `spec`, a surface given as the verb's argument, then the
    /// options of the command line: what is read later wins. Keys of the file are those of every
    /// experiment and the long options of this verb (quiet, threads), which become the value of the
    /// option unless the command line has one. An option of the command line that the other
    /// settings leave without effect is refused; of such a line of the file, unless it says the
    /// default, a note is written: files are made for more than one run. Throws Error(Usage),
    /// Error(InvalidInput, "file:line").
    Experiment read(const std::string& spec = {});

    /// True when one of the experiment's options was given on the command line.
    bool any_given() const;
    /// After read(): true when the number of rays was, there or in the file.

  private:
    void apply_config(Experiment& experiment, const std::string& path);
    /// Throws Error(Usage, option) for one that the chosen kind has no use for.
    void refuse_unused(const Experiment& experiment) const;
    /// Notes the lines of the config file that decide nothing.
    void tell_unused(const Experiment& experiment) const;

    CLI::App* app_ = nullptr;
    CLI::Option* config_ = nullptr;
    bool fresnel_in_config_ = false;
    std::vector<std::pair<std::string, std::string>> config_lines_;  ///< key, "file:line"
    std::vector<std::pair<std::string, CLI::Option*>> options_;      ///< key, option
};

}  // namespace asperity::cli
