"""Vector and point layers in and out: reference systems, styles, words of tables."""
