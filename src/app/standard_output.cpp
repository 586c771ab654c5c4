#include "app/standard_output.hpp"

#include <fcntl.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <cstdio>
#include <cstring>

#include <lamina/error.hpp>
#include <lamina/files.hpp>

namespace lamina::app {

void print_result(const std::string& text) {
    errno = 0;
    if (std::fwrite(text.data(), 1, text.size(), stdout) != text.size() || std::fflush(stdout) != 0)
        throw IoError("standard output", std::string("cannot write: ") + std::strerror(errno != 0 ? errno : EIO));
}

void print_summary(const std::string& text, std::span<const RunFile> outputs) {
    const auto is_stream = [](const RunFile& output) { return is_standard_stream(output.path); };
    if (std::none_of(outputs.begin(), outputs.end(), is_stream)) return print_result(text);
    std::fwrite(text.data(), 1, text.size(), stderr);
}

void guard_closed_streams() {
    for (const int stream : {STDIN_FILENO, STDOUT_FILENO, STDERR_FILENO})
        if (::fcntl(stream, F_GETFD) == -1) ::open("/dev/null", stream == STDIN_FILENO ? O_WRONLY : O_RDONLY);
}

}  // namespace lamina::app
