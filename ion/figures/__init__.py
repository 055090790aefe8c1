"""The paper's figures, drawn again from our own runs and parameters; one module a figure."""
