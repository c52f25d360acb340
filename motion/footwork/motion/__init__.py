"""What both sides share: skeleton, clip, kinematics, contacts, metric, graph, table, bundle."""
