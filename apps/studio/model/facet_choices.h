// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <asperity/optics/optics_settings.h>

#include <QString>

#include <vector>

namespace asperity::studio {

/// An entry of the list of facets, and what choosing it sets.
struct FacetChoice {
    QString label;
    OpticsSettings optics;
};

/// Laws that are no metals, then the tabulated metals, then the laws that a program added, each
/// with the first of no setting, F0 0.04 and index 1.5 that it takes.
std::vector<FacetChoice> facet_choices();

/// The entry that `optics` belongs to; -1 for none, such as a conductor of given indices.
int facet_choice_of(const std::vector<FacetChoice>& choices, const OpticsSettings& optics);

}  // namespace asperity::studio
