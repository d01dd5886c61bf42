"""A Ray cluster of two nodes on this machine, for tests. Prints the address of the cluster.

"kill" on standard input kills the node beside the head as soon as it meshes a part, and prints its id. The end of the input ends the
cluster.
"""

import os
import sys
import time

os.environ["RAY_USAGE_STATS_ENABLED"] = "0"
# A busy machine takes long to start the programs of a node.
os.environ["RAY_raylet_start_wait_time_s"] = "170"
from ray.cluster_utils import Cluster  # noqa: E402

# A dead node is noticed within seconds; by default, within half a minute.
HEALTH = {"health_check_initial_delay_ms": 1000, "health_check_period_ms": 1000, "health_check_failure_threshold": 3}
NODE = {"num_cpus": 1, "memory": 4 << 30, "object_store_memory": 100_000_000}
# Programs that only serve people.
WITHOUT = {"include_dashboard": False, "include_log_monitor": False, "no_monitor": True}


def is_meshing(node):
    import psutil

    raylet = psutil.Process(node.all_processes["raylet"][0].process.pid)
    try:
        return any("mesh" in one.cmdline() for one in raylet.children(recursive=True))
    except psutil.NoSuchProcess:
        return False


def started():
    """Returns a cluster and its node beside the head. On a very busy machine, the first try may take too long for Ray."""
    for is_last in (False, True):
        try:
            cluster = Cluster(initialize_head=True, head_node_args={**NODE, **WITHOUT, "_system_config": HEALTH})
            return cluster, cluster.add_node(**NODE, include_log_monitor=False)
        except Exception:
            if is_last:
                raise


def main():
    cluster, node = started()
    print(cluster.address, flush=True)
    for _ in sys.stdin:
        while not is_meshing(node):
            time.sleep(0.05)
        cluster.remove_node(node, allow_graceful=False)
        print(node.node_id, flush=True)
    cluster.shutdown()


main()
