// SPDX-License-Identifier: Apache-2.0
// A BSDF written in Python, evaluated by whole arrays.
#pragma once

#include "arrays.h"

#include <asperity/bsdf/bsdf.h>
#include <asperity/core/error.h>

#include <array>
#include <exception>
#include <memory>
#include <mutex>
#include <optional>
#include <string>
#include <unordered_map>
#include <vector>

namespace asperity::python {

/// A function of Python as a Bsdf. Python is never asked from inside the library, pair by pair:
/// what is not known yet is 0 and noted, and the work that asked for it is done again once Python
/// has answered all of it in one call. Work whose questions depend on the answers needs a few
/// rounds; each round asks for what the one before could not know.
///
/// sample() draws from a cosine. Thread-safe between rounds.
class OwnBsdf final : public Bsdf {
  public:
    OwnBsdf(nb::object eval, std::string name, int channels, bool isotropic);

    int channels() const override { return channels_; }
    std::string name() const override { return name_; }
    bool isotropic() const override { return isotropic_; }
    void eval(Vec3 wi, Vec3 wo, std::span<double> f) const override;
    std::optional<BsdfSample> sample(Vec3 wi, double u1, double u2) const override;
    double pdf(Vec3 wi, Vec3 wo) const override;
    /// From directions that must not depend on the answers: drawn by a cosine and by mirrors of
    /// four widths, weighted by the balance heuristic (Veach and Guibas 1995). Within a percent for
    /// a lobe about the mirror direction, however narrow down to alpha 0.01.
    void albedo(Vec3 wi, std::span<double> a) const override;

    /// Asks Python, with the GIL held, for what was noted; false when nothing was. Throws
    /// Error(Usage, name) for an answer of another shape, or one that is not finite or negative.
    bool answer();

  private:
    using Pair = std::array<double, 6>;
    struct Hash {
        std::size_t operator()(const Pair& pair) const;
    };
    void ask(const std::vector<Pair>& pairs, std::size_t begin, std::size_t end);

    nb::object eval_;
    std::string name_;
    int channels_;
    bool isotropic_;
    std::vector<std::unique_ptr<Bsdf>> ways_;            ///< in which albedo() draws directions
    std::unordered_map<Pair, std::size_t, Hash> known_;  ///< place in values_
    std::vector<double> values_;
    mutable std::mutex mutex_;
    mutable std::vector<Pair> asked_;
};

/// What work(bsdf) gives once Python has answered all that it asks. Until then work may also fail:
/// what is not known yet is 0.
template <typename Work>
auto with_answers(OwnBsdf& bsdf, Work&& work) {
    using Result = decltype(work(static_cast<const Bsdf&>(bsdf)));
    for (;;) {
        std::optional<Result> result;
        std::exception_ptr failure;
        {
            const nb::gil_scoped_release free;
            try {
                result.emplace(work(static_cast<const Bsdf&>(bsdf)));
            } catch (const Error&) {
                failure = std::current_exception();
            }
        }
        if (PyErr_CheckSignals() != 0) throw nb::python_error();
        if (bsdf.answer()) continue;
        if (failure) std::rethrow_exception(failure);
        return std::move(*result);
    }
}

}  // namespace asperity::python
