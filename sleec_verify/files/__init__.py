"""Files of users: folders, temporary files, TOML, atomic writes."""
