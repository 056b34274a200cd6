// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <asperity/detector/layer_sums.h>
#include <asperity/gonio/measurement.h>

#include <map>
#include <string>
#include <vector>

namespace asperity {

/// Adds up the parts of one experiment (MeasureScope), in any order, to the bits of a run that did
/// all of it. Holds the sums and one part at a time.
class Merge {
  public:
    /// `name`, that of the file, is for messages. Throws Error(InvalidInput, name) for a part of
    /// another experiment, one with a batch that is there already, and one that does not hold what
    /// its errors come from.
    void add(Measurement part, const std::string& name);
    /// The whole. Throws Error(InvalidInput) that names what is missing.
    Measurement finish();
    /// What there is, `stopped`: measure() goes on from it. Without layers where there is nothing.
    Measurement unfinished() &&;

  private:
    struct Source {
        std::string name;
        int part, parts;
        std::map<int, BatchSet> done;  ///< by layer number
    };
    void refuse_overlap(const Source& source) const;
    std::string missing_parts() const;

    Measurement whole_;              ///< without layers
    std::map<int, LayerSums> sums_;  ///< by layer number
    std::vector<Source> sources_;
};

/// True when a run that goes on from this result finds nothing to do; `notes` then has what it
/// would say of layers. With run.until rounds of parts (MeasureScope) are added up until this is
/// true.
bool complete(Measurement& so_far);

}  // namespace asperity
