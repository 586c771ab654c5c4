// Makes handlers of exceptions find the type of what was thrown where there are threads (-fwasm-exceptions -pthread).
//
// Before a handler runs, the code that Clang makes asks the runtime which of the types it names fits. They exchange
// question and answer in `__wasm_lpad_context`. The runtime of Debian's Emscripten has one of it for each thread; Clang
// 14 declares it as one for all, so that it reads an answer that nobody wrote, and only `catch (...)` catches anything.
//
//     handler, Clang 14            runtime, libunwind-mt-except.a
//     writes to 0x1234    -x->     reads from the thread's storage + 0x10
//
// Clang takes the variable of this name that a source has already, if it is of the type it would declare, the nameless
// { i32, i8*, i32 }. A class of C++ has a named type, but for one case: an initial value that the layout of a derived
// class does not mirror makes Clang 14 write its members one by one. The definition is weak, so all sources and the
// runtime share one for each thread. Clang 15 and later need none of this.
#pragma once

#if defined(__EMSCRIPTEN_PTHREADS__) && __clang_major__ < 15

namespace lamina::web {

struct LandingPadQuestion {
    unsigned landing_pad;
    void* types;
};

struct LandingPad : LandingPadQuestion {
    unsigned answer;
};

}  // namespace lamina::web

// The answer is not 0, since a value of zeros alone would have the named type.
extern "C"
    [[gnu::weak, gnu::used]] constinit thread_local lamina::web::LandingPad __wasm_lpad_context = {{0, nullptr}, 1};

#endif
