// Meshes NACA 0012 through the library and writes it: mesh_naca0012 [FILE]
#include <exception>
#include <iostream>

#include <lamina/io.hpp>
#include <lamina/pipeline.hpp>

int main(int argc, char** argv) try {
    lamina::CaseOptions options;
    options.layer.first_height = 1e-4;
    options.layer.layers = 20;
    options.far_field.size = 20;

    const lamina::MeshResult result = lamina::generate_mesh({"naca:0012"}, options);
    const char* file = argc > 1 ? argv[1] : "naca0012.vtu";
    lamina::write_mesh(result.mesh, file);

    std::cout << file << ": " << result.mesh.triangles.size() << " triangles, smallest isotropic angle "
              << result.check.isotropic.min_angle_deg << " degrees\n";
    return 0;
} catch (const std::exception& error) {
    std::cerr << error.what() << '\n';
    return 1;
}
