// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <asperity/bsdf/bsdf_models.h>
#include <asperity/fit/fit_data.h>

#include <string>
#include <vector>

namespace asperity {

/// What becomes of the reflectance of the facets, for models that have one.
enum class FitReflectance {
    Auto,       ///< Run where a run is known, else F0
    Run,        ///< fixed: the law of the run
    F0,         ///< Schlick's, F0 free per channel
    Ior,        ///< of a dielectric, index free per channel
    Conductor,  ///< n and k free per channel
};

/// A number that a fit may change: a parameter of a model, or an entry of a list.
struct FreeParam {
    std::string key;
    int entry = -1;  ///< of a list, from 0; -1: no list
    double low = 0, high = 1;

    /// A coordinate in which a step means about the same everywhere: log(x) where the range knows
    /// no zero, log(1 + x) where it is long, else x; and back.
    double coordinate(double x) const;
    double value(double coordinate) const;
    double lowest() const { return coordinate(low); }
    double highest() const { return coordinate(high); }
    /// Where a search begins: within these, 0.02 .. 20 of a long range, 1e-6 .. 20 of one that
    /// begins below a millionth.
    double search_low() const;
    double search_high() const;
};

/// A model with what is fixed of its settings and what is free.
struct FreeModel {
    BsdfModel model;
    SpecSettings fixed;
    std::vector<FreeParam> free;

    /// With these values for `free`, in its order, each moved into its range.
    std::unique_ptr<Bsdf> make(const std::vector<double>& values) const;
};

/// Reads a model to be fitted, "ggx" or "cook-torrance:metallic=1": what the text gives is fixed.
/// `reflectance` is not Auto. Free are the numbers that always have a value and a range with two
/// ends, lists such as a colour with an entry a channel, those of `reflectance`, and the rows named
/// by `also`, "alpha_y". Throws Error(Usage, text) for what is no model or key, Error(Usage,
/// "model") when nothing is free, Error(Usage, "free") for rows that the model has not or that are
/// no numbers, Error(Usage, "reflectance") for Run where no run is known.
FreeModel free_model(const std::string& text, const FitData& data, FitReflectance reflectance,
                     const std::vector<std::string>& also);

/// "ggx,cook-torrance:metallic=1,k=ibl,beckmann" -> its three models: a piece with "=" and without
/// ":" belongs to the one before.
std::vector<std::string> split_models(const std::string& text);

}  // namespace asperity
