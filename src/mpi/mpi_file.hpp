// A file that all processes write by collective MPI-IO.
#pragma once

#include <mpi.h>

#include <filesystem>
#include <string>
#include <vector>

#include "core/connected_ranks.hpp"

namespace lamina::mpi {

class MpiFile : public core::SharedFile {
public:
    /// Collective: opens the file, or creates it. Where a process cannot open it, all of them know, and nothing is
    /// written.
    MpiFile(MPI_Comm all, const std::filesystem::path& file);
    ~MpiFile() override;

    void write(const std::vector<Block>& blocks) override;
    std::string close() override;

private:
    MPI_Comm all_;
    MPI_File file_ = MPI_FILE_NULL;
    std::string failure_;

    void note(int code);
    void write_at_once(const std::vector<Block>& blocks);
};

}  // namespace lamina::mpi
