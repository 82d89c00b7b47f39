echo "2 passed, 0 failed"
