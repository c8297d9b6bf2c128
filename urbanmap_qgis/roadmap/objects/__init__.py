"""What stands beside a surveyed road: poles, lamp posts, signals, boards, trees, bollards and boxes (J 6.2, Z 4)."""
