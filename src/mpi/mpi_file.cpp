#include "mpi/mpi_file.hpp"

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <numeric>

namespace lamina::mpi {

namespace {

/// Bytes that one call writes: MPI counts them with an int.
constexpr std::size_t bytes_at_once = std::size_t{1} << 30;

/// Cuts blocks into lists that one call can write each.
std::vector<std::vector<core::SharedFile::Block>> calls_for(const std::vector<core::SharedFile::Block>& blocks) {
    std::vector<std::vector<core::SharedFile::Block>> calls(1);
    std::size_t room = bytes_at_once;
    for (core::SharedFile::Block block : blocks)
        while (!block.bytes.empty()) {
            if (room == 0) {
                calls.emplace_back();
                room = bytes_at_once;
            }
            const std::size_t n = std::min(room, block.bytes.size());
            calls.back().push_back({block.offset, block.bytes.substr(0, n)});
            block.offset += n;
            block.bytes.remove_prefix(n);
            room -= n;
        }
    return calls;
}

}  // namespace

MpiFile::MpiFile(MPI_Comm all, const std::filesystem::path& file) : all_(all) {
    note(MPI_File_open(all_, file.c_str(), MPI_MODE_CREATE | MPI_MODE_WRONLY, MPI_INFO_NULL, &file_));
    int failed = !failure_.empty();
    MPI_Allreduce(MPI_IN_PLACE, &failed, 1, MPI_INT, MPI_MAX, all_);
    if (failed != 0) {
        if (file_ != MPI_FILE_NULL) MPI_File_close(&file_);
        file_ = MPI_FILE_NULL;
    }
}

// A process that fails leaves the file open, since closing it is collective: the end of MPI sees to it.
MpiFile::~MpiFile() = default;

void MpiFile::note(int code) {
    if (code == MPI_SUCCESS || !failure_.empty()) return;
    char text[MPI_MAX_ERROR_STRING] = "";
    int length = 0;
    MPI_Error_string(code, text, &length);
    failure_ = "cannot write: " + std::string(text, static_cast<std::size_t>(length));
}

void MpiFile::write(const std::vector<Block>& blocks) {
    if (file_ == MPI_FILE_NULL) return;
    std::vector<std::vector<Block>> calls = calls_for(blocks);
    auto most = static_cast<std::uint64_t>(calls.size());
    MPI_Allreduce(MPI_IN_PLACE, &most, 1, MPI_UINT64_T, MPI_MAX, all_);
    calls.resize(most);
    for (const std::vector<Block>& call : calls) write_at_once(call);
}

/// The view of the file shows the places of the blocks alone, so that one call writes all of them.
void MpiFile::write_at_once(const std::vector<Block>& blocks) {
    std::vector<int> lengths;
    std::vector<MPI_Aint> in_file, in_memory;
    for (const Block& block : blocks) {
        lengths.push_back(static_cast<int>(block.bytes.size()));
        in_file.push_back(static_cast<MPI_Aint>(block.offset));
        MPI_Aint address = 0;
        MPI_Get_address(block.bytes.data(), &address);
        in_memory.push_back(address);
    }
    const int n = static_cast<int>(blocks.size());
    MPI_Datatype places = MPI_BYTE, bytes = MPI_BYTE;
    if (n > 0) {
        MPI_Type_create_hindexed(n, lengths.data(), in_file.data(), MPI_BYTE, &places);
        MPI_Type_create_hindexed(n, lengths.data(), in_memory.data(), MPI_BYTE, &bytes);
        MPI_Type_commit(&places);
        MPI_Type_commit(&bytes);
    }
    note(MPI_File_set_view(file_, 0, MPI_BYTE, places, "native", MPI_INFO_NULL));
    MPI_Status status;
    note(MPI_File_write_all(file_, MPI_BOTTOM, n > 0 ? 1 : 0, bytes, &status));
    // Some implementations report a full disk by the count alone.
    MPI_Count written = 0;
    MPI_Get_elements_x(&status, MPI_BYTE, &written);
    if (written < std::accumulate(lengths.begin(), lengths.end(), MPI_Count{0}) && failure_.empty())
        failure_ = "cannot write: fewer bytes were written than given";
    if (n > 0) {
        MPI_Type_free(&places);
        MPI_Type_free(&bytes);
    }
}

std::string MpiFile::close() {
    if (file_ != MPI_FILE_NULL) note(MPI_File_close(&file_));
    return failure_.empty() && file_ == MPI_FILE_NULL ? std::string() : failure_;
}

}  // namespace lamina::mpi
