// SPDX-License-Identifier: Apache-2.0
#include "facet_choices.h"

#include <asperity/core/error.h>
#include <asperity/optics/materials.h>
#include <asperity/optics/scattering_law.h>

#include <QCoreApplication>

#include <algorithm>
#include <string_view>

namespace asperity::studio {

namespace {

QString text(std::string_view s) {
    return QString::fromUtf8(s.data(), static_cast<qsizetype>(s.size()));
}

QString translated(const char* s) {
    return QCoreApplication::translate("asperity::studio::SimulationFields", s);
}

bool takes(const ScatteringLaw& law, const OpticsSettings& optics) {
    try {
        return !law.channels(optics).empty();
    } catch (const Error&) {
        return false;
    }
}

OpticsSettings first_settings(const ScatteringLaw& law) {
    OpticsSettings none, f0, index;
    none.fresnel = f0.fresnel = index.fresnel = law.kind;
    f0.f0 = {0.04};
    index.ior = {1.5};
    for (const OpticsSettings& optics : {none, f0, index})
        if (takes(law, optics)) return optics;
    return none;  // the run says what is missing
}

}  // namespace

std::vector<FacetChoice> facet_choices() {
    std::vector<FacetChoice> choices(3);
    choices[0].label = translated("Perfect mirrors");
    choices[1].label = translated("Schlick, F0");
    choices[1].optics = first_settings(scattering_law(FresnelKind::Schlick));
    choices[2].label = translated("Dielectric, index");
    choices[2].optics = first_settings(scattering_law(FresnelKind::Dielectric));
    for (const TabulatedMaterial& metal : materials()) {
        FacetChoice choice{QString("%1 (%2)").arg(text(metal.name), text(metal.symbol)), {}};
        choice.optics.fresnel = FresnelKind::Conductor;
        choice.optics.material = metal.symbol;
        choices.push_back(choice);
    }
    for (const ScatteringLaw& law : scattering_laws())
        if (law.kind > FresnelKind::Conductor)
            choices.push_back(
                {text(law.label.empty() ? law.name : law.label), first_settings(law)});
    return choices;
}

int facet_choice_of(const std::vector<FacetChoice>& choices, const OpticsSettings& optics) {
    const auto found = std::find_if(choices.begin(), choices.end(), [&](const FacetChoice& choice) {
        return choice.optics.fresnel == optics.fresnel &&
               (optics.fresnel != FresnelKind::Conductor ||
                choice.optics.material == optics.material);
    });
    return found == choices.end() ? -1 : static_cast<int>(found - choices.begin());
}

}  // namespace asperity::studio
