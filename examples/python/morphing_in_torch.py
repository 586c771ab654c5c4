"""A mesh that moves as a function of PyTorch, and graphs of one connectivity for PyTorch Geometric.

    python morphing_in_torch.py

Both need packages that lamina does not: torch, and torch_geometric for graphs().
"""
import lamina
import numpy as np
import torch


class Morph(torch.autograd.Function):
    """Returns the places of all vertices for parameters of a shape, with the exact derivative."""

    @staticmethod
    def forward(context, parameters, shape):
        context.parameters, context.shape = parameters.detach().numpy(), shape
        return torch.tensor(shape.positions(context.parameters))

    @staticmethod
    def backward(context, gradient):
        return torch.tensor(context.shape.vector_jacobian(context.parameters, gradient.numpy())), None


def graphs(moving, shapes):
    """Returns a graph for each shape: places of the vertices, and the edges of the cells in both directions."""
    from torch_geometric.data import Data

    edges = torch.from_numpy(moving.mesh.edge_index(both_directions=True))
    points, errors = moving.morph_all(moving.walls_on(shape) for shape in shapes)
    return [Data(pos=torch.from_numpy(p), edge_index=edges) for p, error in zip(points, errors) if not error]


if __name__ == "__main__":
    shape = lamina.cst_shape(lamina.MorphMap(lamina.mesh("naca:0012", reynolds=6e6)))
    parameters = torch.zeros(len(shape.initial), dtype=torch.float64, requires_grad=True)
    target = torch.tensor(shape.positions(np.full(len(shape.initial), 0.01)))
    loss = (Morph.apply(parameters, shape) - target).square().sum()
    loss.backward()
    print(parameters.grad)
