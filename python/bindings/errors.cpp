// The errors of the library as Python exceptions that hold the same data. lamina/_errors.py has their classes.
#include <exception>
#include <string>

#include <nanobind/nanobind.h>
#include <nanobind/stl/string.h>
#include <nanobind/stl/vector.h>

#include <lamina/error.hpp>
#include <lamina/limits.hpp>

#include "bindings.hpp"
#include "values.hpp"

namespace lamina::python {

namespace nb = nanobind;

namespace {

/// Returns a message with names of options as Python has them.
nb::object in_python(const std::string& message) {
    return nb::module_::import_("lamina._errors").attr("in_python")(message);
}

/// Sets the exception of this class of lamina._errors, with this data as its attributes.
void set_error(const char* class_name, const Error& error, const nb::dict& data) {
    const nb::object exception = nb::module_::import_("lamina._errors").attr(class_name)(in_python(error.what()));
    for (auto [name, value] : data) nb::setattr(exception, name, value);
    PyErr_SetObject(exception.type().ptr(), exception.ptr());
}

nb::dict option_data(const OptionError& error) {
    nb::dict data;
    data["option"] = error.option();
    data["reason"] = in_python(error.reason());
    return data;
}

nb::dict place_data(const InputError& error) {
    const InputPlace& place = error.place();
    nb::dict data;
    data["reason"] = in_python(error.reason());
    data["file"] = place.file;
    data["line"] = place.line;
    data["at"] = to_python(place.at);
    data["element"] = place.element;
    data["points"] = place.points;
    data["segments"] = place.segments;
    return data;
}

/// Sets the Python exception that stands for this one. Others pass on to nanobind.
void set_error_of(const std::exception_ptr& thrown) {
    nb::dict data;
    try {
        std::rethrow_exception(thrown);
    } catch (const LimitError& error) {
        data = option_data(error);
        data["estimate"] = to_python(error.estimate());
        set_error("LimitError", error, data);
    } catch (const OptionError& error) {
        set_error("OptionError", error, option_data(error));
    } catch (const UsageError& error) {
        set_error("UsageError", error, data);
    } catch (const InputError& error) {
        set_error("InputError", error, place_data(error));
    } catch (const MeshError& error) {
        data["at"] = to_python(error.at());
        set_error("MeshError", error, data);
    } catch (const IoError& error) {
        const nb::object exception =
            nb::module_::import_("lamina._errors").attr("io_error")(error.what(), error.file(), error.reason());
        PyErr_SetObject(exception.type().ptr(), exception.ptr());
    }
}

}  // namespace

void translate_errors() {
    nb::register_exception_translator([](const std::exception_ptr& thrown, void*) {
        try {
            set_error_of(thrown);
        } catch (nb::python_error& error) {
            error.restore();  // making the exception failed
        }
    });
}

}  // namespace lamina::python
