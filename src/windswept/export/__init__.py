"""Plants for other tools: one file a format, one public function each."""
