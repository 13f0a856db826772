"""What does tasks, by name."""

from __future__ import annotations

from .backend import Backend, Unusable

ENGINES = ("dask", "ray")
"""The clusters that there are backends for."""


def open_backend(
    name: str | None, address: str | None = None, workers: int | None = None
) -> Backend:
    """The cluster of an engine at an address `host:port`, else where its environment variable says,
    else one of this machine; without a name, processes of this machine.

    `workers` is the number of processes to start, by default one per core; of a cluster that
    exists, how many of its workers get tasks. Raises Unusable if the engine's package is missing,
    or the cluster cannot be reached.
    """
    if name is None:
        if address is not None:
            raise Unusable(f"an address of a cluster needs `--backend`: {' or '.join(ENGINES)}")
        from .processes import Processes, cores

        return Processes(workers or cores())
    if name == "dask":
        from .dask_cluster import DaskCluster

        return DaskCluster(address, workers)
    from .ray_cluster import RayCluster

    return RayCluster(address, workers)
