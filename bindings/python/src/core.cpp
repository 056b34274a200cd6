// SPDX-License-Identifier: Apache-2.0
#include "core.h"

#include <asperity/core/error.h>
#include <asperity/core/version.h>

#include <exception>

namespace asperity::python {
namespace {

/// Raises asperity.Error, whose class the package brings, for the library's Error.
void translate(const std::exception_ptr& pointer, void* error_class) {
    try {
        std::rethrow_exception(pointer);
    } catch (const Error& error) {
        const nb::handle type(static_cast<PyObject*>(error_class));
        const nb::object raised =
            type(error.message().c_str(), static_cast<int>(error.code()), error.where().c_str());
        PyErr_SetObject(type.ptr(), raised.ptr());
    }
}

}  // namespace
}  // namespace asperity::python

NB_MODULE(_core, module) {
    using namespace asperity::python;
    module.doc() = "The library as the package asperity uses it; not to be used by itself.";
    module.attr("version") = asperity::kVersion;
    // Lives as long as the interpreter
    nb::object error = nb::module_::import_("asperity._errors").attr("Error");
    nb::register_exception_translator(translate, error.release().ptr());
    add_settings(module);
    add_surfaces(module);
    add_measurements(module);
    add_bsdfs(module);
    add_comparisons(module);
    add_fits(module);
    add_exports(module);
    add_renders(module);
}
