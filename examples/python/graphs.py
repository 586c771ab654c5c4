"""Reads meshes round many sections into PyTorch Geometric, in batches, as a graph network would.

    python examples/python/graphs.py --meshes 100

Each mesh is one graph: points with their type and distance from the wall, and edges in both directions.
"""

import argparse
import importlib.util
import time

import lamina


def graphs(count):
    """Yields the graphs of meshes round NACA sections of different camber and thickness."""
    names = [f"naca:{camber}4{thickness:02d}" for thickness in range(8, 25) for camber in range(1, 7)]
    for result in lamina.batch(names[:count], reynolds=1e6, growth=1.3, gradation=0.3):
        if result.error is not None:
            raise result.error
        graph = result.mesh.to_pyg()
        graph.name = result.name
        yield graph


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--meshes", type=int, default=100, choices=range(1, 103), metavar="N")
    parser.add_argument("-o", "--output", default="graphs.pt", help="file of all graphs, for torch.load()")
    arguments = parser.parse_args()
    if importlib.util.find_spec("torch_geometric") is None:
        print("torch_geometric is not installed: pip install torch torch_geometric")
        return
    import torch
    from torch_geometric.loader import DataLoader

    start = time.perf_counter()
    data = list(graphs(arguments.meshes))
    torch.save(data, arguments.output)
    loader = DataLoader(data, batch_size=16, shuffle=True)
    for number, batch in enumerate(loader):
        print(f"batch {number}: {batch.num_graphs} meshes, {batch.num_nodes:,} points, {batch.num_edges:,} edges")
    print(f"{len(data)} meshes in {time.perf_counter() - start:.1f} s")


if __name__ == "__main__":
    main()
