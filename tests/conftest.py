"""What all tests share: the processor's settings, made before numpy loads, as the command does."""

from scenarios.processor import fix_processor

fix_processor()
