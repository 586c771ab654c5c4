// The functions of the module. web/src/lamina.ts wraps it: nobody else should call it.
//
// An exception of C++ means nothing to JavaScript. Functions that may throw return an object instead, either
// {value: ...} or {error: {kind, message, ...}}, of which lamina.ts makes an exception again.
#include <exception>
#include <new>
#include <string>

#include <emscripten/bind.h>

#include <lamina/error.hpp>
#include <lamina/io.hpp>
#include <lamina/threads.hpp>
#include <lamina/version.hpp>

#include "meshes.hpp"
#include "request.hpp"
#include "values.hpp"

namespace {

using emscripten::val;
using namespace lamina;
using namespace lamina::web;

val failure(const char* kind, const std::string& message) {
    val error = val::object();
    error.set("kind", std::string(kind));
    error.set("message", message);
    return error;
}

/// Describes the exception that is on its way.
val current_failure() {
    try {
        throw;
    } catch (const InputError& e) {
        val error = failure("input", e.what());
        error.set("file", e.place().file);
        error.set("line", static_cast<double>(e.place().line));
        error.set("at", to_javascript(e.place().at));
        return error;
    } catch (const OptionError& e) {
        val error = failure("option", e.what());
        error.set("option", e.option());
        return error;
    } catch (const UsageError& e) {
        return failure("usage", e.what());
    } catch (const MeshError& e) {
        val error = failure("mesh", e.what());
        error.set("at", to_javascript(e.at()));
        return error;
    } catch (const IoError& e) {
        val error = failure("io", e.what());
        error.set("file", e.file());
        return error;
    } catch (const std::bad_alloc&) {
        return failure("memory", "out of memory: a page may use 4 GB");
    } catch (const std::exception& e) {
        return failure("internal", e.what());
    }
}

/// Calls f() and returns {value: its result} or {error: ...}.
template <class F>
val reply_of(F f) {
    val reply = val::object();
    try {
        reply.set("value", f());
    } catch (...) {
        reply.set("error", current_failure());
    }
    return reply;
}

val formats() {
    val list = val::array();
    for (const MeshFormat& format : mesh_formats()) {
        val entry = val::object();
        entry.set("name", format.name);
        entry.set("extensions", to_javascript(format.extensions));
        entry.set("description", format.description);
        list.call<void>("push", entry);
    }
    return list;
}

}  // namespace

EMSCRIPTEN_BINDINGS(lamina) {
    emscripten::constant("version", std::string(LAMINA_VERSION));
    emscripten::class_<HeldMesh>("HeldMesh")
        .function("arrays", &HeldMesh::arrays)
        .function("hash", &HeldMesh::hash)
        .function(
            "write", +[](const HeldMesh& mesh, std::string file, std::string format, bool wall_distance) {
                return reply_of([&] {
                    mesh.write(file, format, wall_distance);
                    return val::undefined();
                });
            });
    emscripten::function("formats", &formats);
    emscripten::function("threadCount", &thread_count);
    emscripten::function("optionRows", &option_rows);
    emscripten::function(
        "generate", +[](val inputs, val options, val progress) {
            return reply_of([&] { return generate(inputs, options, progress); });
        });
    emscripten::function(
        "outlines", +[](val inputs) { return reply_of([&] { return outlines(inputs); }); });
    emscripten::function(
        "delaunay", +[](val points) { return reply_of([&] { return delaunay(points); }); });
}
