"""What stands beside a surveyed road: poles, lamp posts, signals, boards and trees (J 6.2, Z 4)."""
