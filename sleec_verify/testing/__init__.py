"""What the pytest plugin does once there is something to do; the plugin itself is `sleec_verify.pytest_plugin`."""
