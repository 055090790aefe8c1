"""A road in a wide corridor, which glare hides for a while."""
