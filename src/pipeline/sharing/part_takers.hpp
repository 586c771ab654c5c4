// Where the parts of a mesh go once they are numbered: into a mesh, or to a sink.
#pragma once

#include <functional>
#include <memory>
#include <span>

#include <lamina/mesh_sink.hpp>

#include "decoupling/subdomain.hpp"

namespace lamina::pipeline {

/// Takes the parts of a mesh in their order.
class PartTaker {
public:
    /// Does what is left to do for a part once all parts before it are taken.
    using Append = std::function<void()>;

    PartTaker() = default;
    PartTaker(const PartTaker&) = delete;
    PartTaker& operator=(const PartTaker&) = delete;
    virtual ~PartTaker() = default;

    /// Does what can be done for a part before those before it are taken, and returns the rest. May be called on
    /// several threads at once, but what it returns is called by one at a time. `owner` holds the arrays of a part that
    /// a subdomain has made; those of other parts outlive this object.
    virtual Append prepare(const MeshPart& part, std::shared_ptr<const Refinement> owner) = 0;

    /// Takes the next part at once.
    void take(const MeshPart& part) { prepare(part, nullptr)(); }
};

/// Makes a mesh of the parts, without markers and constraints.
class MeshTaker final : public PartTaker {
public:
    /// Expects about as many cells as the layer has and as the subdomains should have by estimate.
    MeshTaker(const decoupling::Decoupling& decoupling, Mesh& mesh) : decoupling_(decoupling), mesh_(mesh) {}

    Append prepare(const MeshPart& part, std::shared_ptr<const Refinement> owner) override;

private:
    const decoupling::Decoupling& decoupling_;
    Mesh& mesh_;

    void append(const MeshPart& part);
    void reserve();
};

/// Formats the parts for a sink.
class SinkTaker final : public PartTaker {
public:
    explicit SinkTaker(MeshSink& sink) : sink_(sink) {}

    Append prepare(const MeshPart& part, std::shared_ptr<const Refinement> owner) override;

private:
    MeshSink& sink_;
};

}  // namespace lamina::pipeline
